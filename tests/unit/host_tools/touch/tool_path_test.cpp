// A tool's path: its rows, and the path at another rate against a straight line from row to row.
#include "host_tools/touch/tool_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;

class ToolPathTest : public ::testing::Test {
 protected:
  ToolPath path_of(const std::string& rows) {
    return ToolPath(folder_.write("path.csv", "t_s,x_m,y_m,z_m\n" + rows).string());
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(ToolPathTest, HasATickARowWithTheVelocityFromTheRowBefore) {
  const ToolPath path = path_of("0.5,0,0,0\n0.6,0.01,0,-0.02\n0.9,0.04,0.03,-0.02\n");
  ASSERT_EQ(path.size(), 3U);
  EXPECT_EQ(path.time_s(2), 0.9);
  EXPECT_EQ(path.tool(1).p_W, Vec3(0.01, 0.0, -0.02));
  EXPECT_EQ(path.tool(0).v_W, Vec3::Zero());
  EXPECT_LT((path.tool(1).v_W - Vec3(0.1, 0.0, -0.2)).norm(), 1e-12);
  EXPECT_LT((path.tool(2).v_W - Vec3(0.1, 0.1, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(path.step_s(0), 0.1, 1e-15) << "of the first tick that to the second";
  EXPECT_NEAR(path.step_s(1), 0.1, 1e-15);
  EXPECT_NEAR(path.step_s(2), 0.3, 1e-15);
  EXPECT_EQ(path_of("0,0,0,0\n").step_s(0), 1e-3);
}

TEST_F(ToolPathTest, IsStraightFromRowToRowAtAnotherRate) {
  const std::array<double, 5> times{-0.2, 0.05, 0.051, 0.4, 0.8};
  const std::array<Vec3, 5> places{Vec3(0.0, 0.01, 0.0), Vec3(0.02, -0.01, 0.0),
                                   Vec3(0.03, -0.01, 0.01), Vec3(-0.05, 0.0, 0.02),
                                   Vec3(0.0, 0.0, 0.0)};
  std::string rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    rows += std::to_string(times[i]);
    for (const double number : places[i]) {
      rows += "," + std::to_string(number);
    }
    rows += "\n";
  }
  const ToolPath path = path_of(rows);
  for (const double rate_Hz : {7.0, 100.0, 1000.0, 4096.0}) {
    const ToolPath sampled = path.sampled(rate_Hz);
    ASSERT_EQ(sampled.size(), static_cast<std::size_t>(std::floor(rate_Hz + 1e-6)) + 1);
    for (std::size_t k = 0; k < sampled.size(); ++k) {
      const double t = -0.2 + static_cast<double>(k) / rate_Hz;
      ASSERT_NEAR(sampled.time_s(k), t, 1e-15);
      // The sum of hats over the rows is the broken line through them.
      Vec3 expected = Vec3::Zero();
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double rise = i == 0 ? 1.0 : (t - times[i - 1]) / (times[i] - times[i - 1]);
        const double fall =
            i + 1 == times.size() ? 1.0 : (times[i + 1] - t) / (times[i + 1] - times[i]);
        expected += std::max(0.0, std::min({1.0, rise, fall})) * places[i];
      }
      ASSERT_LT((sampled.tool(k).p_W - expected).norm(), 1e-13) << k;
    }
  }
}

TEST_F(ToolPathTest, EndsAtItsLastRowAlsoWhereRoundingPutsTheTickBehindIt) {
  const ToolPath path = path_of("0,0,0,0\n0.3,0.03,0,0\n");
  const ToolPath sampled = path.sampled(1000.0);  // 0.3 * 1000 rounds to less than 300
  ASSERT_EQ(sampled.size(), 301U);
  EXPECT_NEAR(sampled.tool(300).p_W.x(), 0.03, 1e-15);
  EXPECT_EQ(path.sampled(2.0).size(), 1U) << "a tick later than the end is none of the path's";
  const ToolPath point = path_of("0.1,0.01,0.02,0.03\n").sampled(1000.0);
  ASSERT_EQ(point.size(), 1U);
  EXPECT_EQ(point.tool(0).p_W, Vec3(0.01, 0.02, 0.03));
}

TEST_F(ToolPathTest, RefusesTimesThatDoNotGrowAndWarnsOfMillimetres) {
  EXPECT_TRUE(contains(input_error([&] { path_of("0,0,0,0\n0,0,0,0\n"); }),
                       "path.csv:3: column t_s: 0 does not come after 0"));
  EXPECT_EQ(path_of("0,0,0,0\n1,4,0,0\n").warning(), std::nullopt);
  const auto warning = path_of("0,0,0,0\n1,40,0,0\n").warning();
  ASSERT_TRUE(warning.has_value());
  EXPECT_TRUE(contains(*warning, "path.csv:3: the tool is 40 m from the world's origin"));
}

}  // namespace
}  // namespace tactus::host
