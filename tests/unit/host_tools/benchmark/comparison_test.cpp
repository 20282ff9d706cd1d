// Two programs' figures: how they are read and paired, and that both really run. The other program
// is a script that writes known figures.
#include "host_tools/benchmark/comparison.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

constexpr const char* kOldFigures =
    "mesh,triangles,radius_mm,friction,ticks,median_ns,p99_ns,p999_ns,max_ns,instructions_median\n"
    "# a machine\n"
    "sphere,1280,2,1,20000,350,1942,3005,8012,3630\n"
    "bunny,75408,2,1,20000,400,2000,4000,9000,\n";

TEST(Comparison, FiguresOfAnEarlierVersionAreOfJumps) {
  TemporaryFolder folder;
  const auto rows = read_figures(folder.write("old.csv", kOldFigures));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].mesh, "sphere");
  EXPECT_EQ(rows[0].motion, "jumps");
  EXPECT_EQ(rows[0].p999_ns, 3005.0);
  EXPECT_EQ(rows[0].instructions, 3630.0);
  EXPECT_FALSE(rows[1].instructions);
  EXPECT_FALSE(rows[1].late_ticks);
}

TEST(Comparison, AFileThatHoldsNoFiguresIsToldWithItsLine) {
  TemporaryFolder folder;
  const auto error = [&](const char* text) {
    return input_error([&] { (void)read_figures(folder.write("bad.csv", text)); });
  };
  EXPECT_TRUE(contains(error("mesh,radius_mm\nball,2\n"), "bad.csv:2: no column median_ns"));
  EXPECT_TRUE(contains(error("mesh,radius_mm\nball,2,3\n"), "bad.csv:2: 3 fields"));
  EXPECT_TRUE(
      contains(error("mesh,radius_mm\nball,two\n"), "column radius_mm: 'two' is no number"));
  EXPECT_TRUE(contains(error("mesh\n"), "no figures in it"));
}

TEST(Comparison, TheLeastTimeOfAllTurnsCountsAndRowsOfOneProgramAloneAreLeftOut) {
  std::vector<FigureRow> here{{.mesh = "a", .median_ns = 5.0, .p99_ns = 7.0, .p999_ns = 9.0},
                              {.mesh = "b", .median_ns = 1.0}};
  keep_least(here, {{.mesh = "a", .median_ns = 6.0, .p99_ns = 6.0, .p999_ns = 8.0},
                    {.mesh = "b", .median_ns = 2.0}});
  EXPECT_EQ(here[0].median_ns, 5.0);
  EXPECT_EQ(here[0].p99_ns, 6.0);
  EXPECT_EQ(here[0].p999_ns, 8.0);
  const auto rows = paired(here, {{.mesh = "b", .triangles = 1280.0, .median_ns = 3.0},
                                  {.mesh = "b", .median_ns = 4.0},
                                  {.mesh = "b", .radius_mm = 2.0}});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].here.median_ns, 1.0);
  EXPECT_EQ(rows[0].there.median_ns, 4.0);
  EXPECT_FALSE(input_error([&] { keep_least(here, {{.mesh = "a"}}); }).empty());
}

TEST(Comparison, AFolderWithoutTheProgramIsToldWithTheRemedy) {
  TemporaryFolder folder;
  EXPECT_TRUE(contains(input_error([&] { (void)program_in(folder.path()); }),
                       "no program tactus in it or in its bin/; build the other commit"));
}

TEST(Comparison, TheProgramRunsBesideAnotherBuildOfItself) {
  TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "bin");
  const auto other = folder.path() / "bin" / "tactus";
  (void)folder.write("bin/tactus",
                     "#!/bin/sh\nexec '" + testing::built_program("tactus") + "' \"$@\"\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  (void)folder.write(
      "box.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const auto outcome = testing::run_program(
      folder.path(), "bench touch --mesh box.off --ticks 50 --runs 2 --radius-m 0.002 --against .");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(contains(outcome.output, "box           4 2 mm hand"));
  EXPECT_TRUE(contains(outcome.output, "box           4 2 mm jumps"));
  const auto gravel = testing::run_program(
      folder.path(), "bench touch --gravel --ticks 50 --runs 1 --radius-m 0.002 --against .");
  EXPECT_EQ(gravel.exit_code, 0) << gravel.output;
  EXPECT_TRUE(contains(gravel.output, "gravel   320000 2 mm hand"));
  EXPECT_TRUE(contains(gravel.output, "gravel   320000 2 mm jumps"));
  const auto refused = testing::run_program(folder.path(), "bench sim --against .");
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_TRUE(contains(refused.output, "--against compares touch alone"));
}

}  // namespace
}  // namespace tactus::host
