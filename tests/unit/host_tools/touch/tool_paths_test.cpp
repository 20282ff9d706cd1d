// The paths of several tools: their common clock, and what is told of paths that have none.
#include "host_tools/touch/tool_paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;

class ToolPathsTest : public ::testing::Test {
 protected:
  ToolPath path_of(const std::string& name, const std::string& rows) {
    return ToolPath(folder_.write(name, "t_s,x_m,y_m,z_m\n" + rows).string());
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(ToolPathsTest, LastAsLongAsTheLongestAndRestWhereTheyEnd) {
  const ToolPaths paths({path_of("a.csv", "0.5,0,0,0\n0.6,0.01,0,0\n"),
                         path_of("b.csv", "0.5,1,0,0\n0.6,1,0.02,0\n0.9,1,0.05,0\n1,1,0.06,0\n"),
                         path_of("c.csv", "0.5,2,0,0\n")});
  EXPECT_EQ(paths.tools(), 3U);
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_EQ(paths.time_s(2), 0.9);
  EXPECT_NEAR(paths.step_s(2), 0.3, 1e-15);
  EXPECT_NEAR(paths.tool(0, 1).v_W.x(), 0.1, 1e-12);
  EXPECT_NEAR(paths.tool(1, 2).v_W.y(), 0.1, 1e-12);
  for (std::size_t tick = 2; tick < 4; ++tick) {
    EXPECT_EQ(paths.tool(0, tick).p_W, Vec3(0.01, 0.0, 0.0));
    EXPECT_EQ(paths.tool(0, tick).v_W, Vec3::Zero());
    EXPECT_EQ(paths.tool(2, tick).p_W, Vec3(2.0, 0.0, 0.0));
    EXPECT_EQ(paths.tool(2, tick).v_W, Vec3::Zero());
  }
}

TEST_F(ToolPathsTest, MayRoundTheirTimesButNotDriftApart) {
  std::string exact;
  std::string rounded;
  std::string drifting;
  for (int k = 0; k < 3000; ++k) {
    exact += fmt::format("{},0,0,0\n", k / 3000.0);
    rounded += fmt::format("{:.6f},0,0,0\n", k / 3000.0);
    drifting += fmt::format("{:.6f},0,0,0\n", k * 0.000333);
  }
  const ToolPath clock = path_of("exact.csv", exact);
  EXPECT_EQ(ToolPaths({clock, path_of("rounded.csv", rounded)}).size(), 3000U);
  const std::string message =
      input_error([&] { ToolPaths({clock, path_of("drifting.csv", drifting)}); });
  EXPECT_TRUE(contains(message, "drifting.csv:"));
  EXPECT_TRUE(contains(message, "which is 0.000333 s after"));
  EXPECT_TRUE(contains(message, "exact.csv:"));
  EXPECT_TRUE(contains(message, "which is 0.000333333 s after"));
}

TEST_F(ToolPathsTest, RefuseOtherTimesByFileAndLine) {
  const ToolPath fast = path_of("fast.csv", "0,0,0,0\n0.001,0,0,0\n0.002,0,0,0\n");
  const ToolPath slow = path_of("slow.csv", "0,0,0,0\n0.002,0,0,0\n");
  const std::string message = input_error([&] { ToolPaths({fast, slow}); });
  EXPECT_TRUE(contains(message, "slow.csv:3: 0.002 s, which is 0.002 s after the row before"));
  EXPECT_TRUE(contains(message, "fast.csv:3: 0.001 s, which is 0.001 s after the row before"));
  EXPECT_TRUE(contains(message, "give --rate"));
  EXPECT_EQ(ToolPaths({fast.sampled(1000.0), slow.sampled(1000.0)}).size(), 3U);
  const ToolPath late = path_of("late.csv", "0.5,0,0,0\n0.501,0,0,0\n");
  EXPECT_TRUE(contains(input_error([&] { ToolPaths({fast, late}); }),
                       "late.csv:2: the path begins at 0.5 s, but "));
  EXPECT_TRUE(contains(input_error([&] { ToolPaths({fast.sampled(500.0), late.sampled(500.0)}); }),
                       "fast.csv at 0 s; let all paths begin at one time"));
}

TEST_F(ToolPathsTest, AreAtMostTen) {
  const std::vector<ToolPath> ten(10, path_of("a.csv", "0,0,0,0\n"));
  EXPECT_EQ(ToolPaths(ten).tools(), 10U);
  const std::vector<ToolPath> eleven(11, ten.front());
  EXPECT_TRUE(contains(input_error([&] { (void)ToolPaths(eleven); }),
                       "--path: 11 paths; a world has 1 to 10 tools"));
  EXPECT_TRUE(contains(input_error([] { (void)ToolPaths({}); }), "--path: 0 paths"));
}

}  // namespace
}  // namespace tactus::host
