// `tactus touch` with several paths. The oracle is the program with each path alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/touch/tool_record.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::Outcome;

// A wall at rest about x = 0, a plate that goes up and down about x = 0.5, and a force that changes
// with time: a world that is stepped too often, or too seldom, gives other bits.
constexpr std::string_view kWallAndPlate = R"([tool]
radius_m = 0.002

[[object]]
name = "wall"
primitive = "box"
size_m = [0.6, 0.02, 0.2]
position_m = [0.0, -0.01, 0.0]
stiffness_N_per_m = 800.0
damping_Ns_per_m = 0.5
friction = { static = 0.4, dynamic = 0.3 }

[[object]]
name = "plate"
primitive = "box"
size_m = [0.1, 0.02, 0.1]
position_m = [0.5, -0.01, 0.0]
stiffness_N_per_m = 600.0
motion = { sway_m = [0.0, 0.004, 0.0], sway_hz = 5.0 }

[[effect]]
law = "vibration"
direction = [1.0, 0.0, 0.0]
amplitude_N = 0.1
frequency_Hz = 30.0
max_force_N = 0.2
)";

class SeveralTools : public ::testing::Test {
 protected:
  void SetUp() override {
    (void)folder.write("scene.toml", kWallAndPlate);
    const Outcome baked = run("bake scene.toml");
    ASSERT_EQ(baked.exit_code, 0) << baked.output;
  }

  Outcome run(const std::string& arguments) const {
    return testing::run_program(folder.path(), arguments);
  }
  // Runs `tactus touch scene.tactus` with these arguments. Returns what it prints.
  std::string touch(const std::string& arguments) const {
    const Outcome outcome = run("touch scene.tactus " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output;
  }
  // Expects that `tactus touch` refuses the arguments and writes nothing.
  void expect_refused(const std::string& arguments, std::string_view why) const {
    const Outcome outcome = run("touch scene.tactus " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(outcome.output, why)) << arguments;
    EXPECT_FALSE(exists("run.csv")) << arguments;
    EXPECT_FALSE(exists("run.2.csv")) << arguments;
  }

  // Writes a path that goes down onto y = 0 about this x, and strokes. Its rows are a millisecond
  // apart.
  void write_path(const std::string& name, double x_m, int rows) const {
    std::string text = "t_s,x_m,y_m,z_m\n";
    for (int k = 0; k < rows; ++k) {
      text += fmt::format("{},{},{},{}\n", 0.001 * k, x_m + 0.01 * std::sin(0.02 * k),
                          0.006 * std::cos(0.01 * k), 0.00002 * k);
    }
    (void)folder.write(name, text);
  }

  [[nodiscard]] std::string content(const std::string& name) const {
    return read_file(folder.path() / name);
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(folder.path() / name);
  }
  [[nodiscard]] CsvTable table(const std::string& name) const {
    constexpr std::array<std::string_view, 7> kColumns{
        "t_s", "tool_x_m", "tool_y_m", "tool_z_m", "force_x_N", "force_y_N", "force_z_N"};
    return CsvTable::read((folder.path() / name).string(), kColumns);
  }

  testing::TemporaryFolder folder;
};

TEST_F(SeveralTools, FarApartFeelWhatEachWouldFeelAlone) {
  write_path("left.csv", 0.0, 600);
  write_path("right.csv", 0.5, 600);
  const std::string summary =
      touch("--path left.csv --path right.csv -o run.csv --explain steps.csv");
  const std::string left = touch("--path left.csv -o left_run.csv --explain left_steps.csv");
  const std::string right = touch("--path right.csv -o right_run.csv --explain right_steps.csv");
  EXPECT_EQ(content("run.csv"), content("left_run.csv"));
  EXPECT_EQ(content("run.2.csv"), content("right_run.csv"));
  EXPECT_EQ(content("steps.csv"), content("left_steps.csv"));
  EXPECT_EQ(content("steps.2.csv"), content("right_steps.csv"));
  EXPECT_NE(content("run.csv"), content("run.2.csv"));
  // The summary has the line of each alone, with the name of its own file.
  EXPECT_EQ(summary, "run.csv" + left.substr(std::string_view("left_run.csv").size()) +
                         "run.2.csv" + right.substr(std::string_view("right_run.csv").size()));
  EXPECT_FALSE(contains(summary, " 0 in contact"));
}

TEST_F(SeveralTools, StayWhereTheirPathsEnd) {
  write_path("short.csv", 0.0, 320);
  write_path("long.csv", 0.2, 500);
  touch("--path short.csv --path long.csv -o run.csv");
  touch("--path short.csv -o alone.csv");
  touch("--path long.csv -o long_alone.csv");
  const std::string alone = content("alone.csv");
  EXPECT_EQ(content("run.csv").substr(0, alone.size()), alone);
  const CsvTable run = table("run.csv");
  const CsvTable other = table("run.2.csv");
  ASSERT_EQ(run.rows(), 500U);
  ASSERT_EQ(other.rows(), 500U);
  for (const std::string column : {"tool_x_m", "tool_y_m", "tool_z_m"}) {
    for (std::size_t row = 320; row < 500; ++row) {
      ASSERT_EQ(run.column(column)[row], run.column(column)[319]) << column << " in row " << row;
      ASSERT_EQ(run.column("t_s")[row], other.column("t_s")[row]);
    }
  }
  // On the wall, which is at rest, the force across the vibration is that of the first tick at
  // rest; 3 mm below the wall it is no small one.
  for (const std::string column : {"force_y_N", "force_z_N"}) {
    for (std::size_t row = 321; row < 500; ++row) {
      ASSERT_EQ(run.column(column)[row], run.column(column)[320]) << column << " in row " << row;
    }
  }
  EXPECT_GT(run.column("force_y_N")[499], 2.0);
  EXPECT_EQ(content("run.2.csv"), content("long_alone.csv"));
}

TEST_F(SeveralTools, AreUpToTenWithAFileForEach) {
  std::string paths;
  for (int i = 0; i < 10; ++i) {
    write_path(fmt::format("path{}.csv", i), -0.25 + 0.05 * i, 340);
    paths += fmt::format("--path path{}.csv ", i);
  }
  touch(paths + "-o out.v1.csv");
  for (int i = 0; i < 10; ++i) {
    touch(fmt::format("--path path{}.csv -o alone.csv", i));
    const std::string name = i == 0 ? "out.v1.csv" : fmt::format("out.v1.{}.csv", i + 1);
    EXPECT_EQ(content(name), content("alone.csv")) << name;
  }
  EXPECT_FALSE(exists("out.v1.1.csv") || exists("out.v1.11.csv"));
  expect_refused(paths + "--path path0.csv -o run.csv",
                 "tactus touch: --path: 11 paths; a world has 1 to 10 tools, each with a path\n");
}

TEST_F(SeveralTools, HaveOneClock) {
  write_path("left.csv", 0.0, 300);
  (void)folder.write("corners.csv",
                     "t_s,x_m,y_m,z_m\n0,0.5,0.01,0\n0.25,0.5,-0.002,0\n0.5,0.5,0.01,0\n");
  expect_refused("--path left.csv --path corners.csv -o run.csv",
                 "tactus touch: corners.csv:3: 0.25 s, which is 0.25 s after the row before, but "
                 "left.csv:3: 0.001 s, which is 0.001 s after the row before");
  touch("--path left.csv --path corners.csv --rate 2000 -o run.csv");
  touch("--path corners.csv --rate 2000 -o alone.csv");
  EXPECT_EQ(content("run.2.csv"), content("alone.csv"));
  EXPECT_EQ(table("run.csv").rows(), 1001U);
}

TEST_F(SeveralTools, LoseNoFile) {
  write_path("left.csv", 0.0, 10);
  write_path("run.2.csv", 0.5, 10);
  const std::string before = content("run.2.csv");
  const Outcome input = run("touch scene.tactus --path left.csv --path run.2.csv -o run.csv");
  EXPECT_EQ(input.exit_code, 2);
  EXPECT_TRUE(contains(input.output, "run.2.csv: is the input run.2.csv, which would be lost"));
  EXPECT_EQ(content("run.2.csv"), before);
  std::filesystem::remove(folder.path() / "run.2.csv");
  expect_refused("--path left.csv --path left.csv -o run.csv --explain run.2.csv",
                 "run.2.csv: is named for two outputs");
  expect_refused("--path left.csv --path left.csv -o /dev/stdout",
                 "/dev/stdout: is a pipe or a terminal, which takes the rows of one tool, and "
                 "there are 2; name a file");
  std::filesystem::create_directory(folder.path() / "out.2.csv");
  const Outcome taken = run("touch scene.tactus --path left.csv --path left.csv -o out.csv");
  EXPECT_TRUE(contains(taken.output, "out.2.csv: is a folder"));
  EXPECT_FALSE(exists("out.csv"));
}

TEST_F(SeveralTools, AreToldAndDrawnByTheirFiles) {
  write_path("left.csv", 0.0, 400);
  // The scene may stand behind a path, which is one file.
  const Outcome outcome =
      run("touch --path left.csv --path left.csv scene.tactus -o run.csv --explain s.csv --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::size_t second = outcome.output.find('\n') + 1;
  EXPECT_TRUE(outcome.output.starts_with(R"({"output":"run.csv","ticks":400,)")) << outcome.output;
  EXPECT_TRUE(outcome.output.substr(second).starts_with(R"({"output":"run.2.csv","ticks":400,)"))
      << outcome.output;
  EXPECT_EQ(run("plot run.2.csv --scene scene.tactus").output,
            "./run.2_force.png\n./run.2_path.png\n");
  EXPECT_EQ(run("plot s.2.csv --explain --tick 350 --scene scene.tactus").output,
            "./s.2_tick350.png\n");
  EXPECT_TRUE(exists("run.2_force.png") && exists("run.2_path.png") && exists("s.2_tick350.png"));
}

TEST(FileOfTool, HasTheToolsNumberBeforeItsExtension) {
  EXPECT_EQ(file_of_tool("a/run.csv", 0), "a/run.csv");
  EXPECT_EQ(file_of_tool("a/run.csv", 1), "a/run.2.csv");
  EXPECT_EQ(file_of_tool("/a.b/run", 9), "/a.b/run.10");
  EXPECT_EQ(file_of_tool("", 1), "");
}

}  // namespace
}  // namespace tactus::host
