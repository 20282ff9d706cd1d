#include "host_tools/plot/run_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::FrictionState;

constexpr std::string_view kTouchHeader =
    "t_s,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,"
    "contact,depth_m,"
    "friction_state\n";

std::string file_with(std::string_view text) {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = ::testing::TempDir() + "tactus_" + test->name() + ".csv";
  std::ofstream(name, std::ios::binary) << text;
  return name;
}

std::vector<RunRow> rows_of(const std::vector<FrictionState>& states) {
  std::vector<RunRow> rows;
  rows.reserve(states.size());
  for (const FrictionState state : states) {
    rows.push_back({.t_s = 0.001 * static_cast<double>(rows.size()), .friction = state});
  }
  return rows;
}

TEST(RunData, ReadsTheColumnsOfTouch) {
  const RunData run =
      read_run(file_with(std::string(kTouchHeader) + "0,0,0,0,0,0,0,0,0,0,0,0,0\n"
                                                     "0.001,1,2,3,4,5,6,3,0,4,1,0.002,2\n"));
  ASSERT_EQ(run.rows.size(), 2U);
  EXPECT_FALSE(run.has_commanded);
  EXPECT_EQ(run.rows[1].proxy_W, Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(run.rows[1].force_N, 5.0);
  EXPECT_EQ(run.rows[1].commanded_N, 5.0);
  EXPECT_TRUE(run.rows[1].contact);
  EXPECT_EQ(run.rows[1].friction, FrictionState::slip);
  EXPECT_TRUE(run.rows[0].located);
}

TEST(RunData, RefusesTimesThatStandStillAndStatesThatDoNotExist) {
  const std::string row = "0,0,0,0,0,0,0,0,0,0,0,0,0\n";
  EXPECT_THROW(read_run(file_with(std::string(kTouchHeader) + row + row)), InputError);
  EXPECT_THROW(read_run(file_with(std::string(kTouchHeader) + "0,0,0,0,0,0,0,0,0,0,0,0,3\n")),
               InputError);
}

TEST(RunData, ThinningKeepsEndsAndExtremes) {
  std::vector<RunRow> rows(100000);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].t_s = static_cast<double>(i);
    rows[i].force_N = 1.0;
  }
  rows[54321].force_N = 9.0;
  rows[77777].force_N = 0.0;
  const std::vector<std::size_t> kept = thin(rows, 1000);
  EXPECT_LE(kept.size(), 1100U);
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), rows.size() - 1);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  EXPECT_TRUE(std::ranges::binary_search(kept, 54321U));
  EXPECT_TRUE(std::ranges::binary_search(kept, 77777U));
}

TEST(RunData, ThinningKeepsAllOfAShortRun) {
  EXPECT_EQ(thin(rows_of(std::vector<FrictionState>(7)), 1000).size(), 7U);
}

TEST(RunData, StretchesJoinNeighbouringRows) {
  using enum FrictionState;
  const std::vector<Stretch> found =
      stretches(rows_of({free, stick, stick, slip, stick, slip, slip}), stick);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].from_s, 0.001);
  EXPECT_EQ(found[0].to_s, 0.003);
  EXPECT_EQ(found[1].from_s, 0.004);
  EXPECT_EQ(found[1].to_s, 0.005);
}

}  // namespace
}  // namespace tactus::host
