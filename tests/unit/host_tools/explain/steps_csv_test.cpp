// The program writes a row for each thing that happened, and feels the same with and without an
// explanation.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/csv/csv_text.h"
#include "host_tools/files/atomic_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/png_size.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class StepsCsvTest : public FolderTest {
 protected:
  // Bakes an example scene to scene.tactus.
  void bake(const std::string& example) {
    example_ = testing::in_repository("host_tools/examples/" + example);
    run("bake '" + example_ + "/scene.toml' -o scene.tactus");
  }

  void run(const std::string& arguments) const {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    ASSERT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.output;
  }

  // Touches along the example's stroke with and without an explanation, which is steps.csv.
  void touch_twice() const {
    const std::string touch = "touch scene.tactus --path '" + example_ + "/stroke.csv' -o ";
    run(touch + "plain.csv");
    run(touch + "run.csv --explain steps.csv");
    EXPECT_EQ(read_file(file("run.csv")), read_file(file("plain.csv")));
  }

  // Counts the rows of steps.csv by their kind.
  [[nodiscard]] std::map<std::string, int> rows() const {
    const std::string text = read_file(file("steps.csv"));
    CsvText table(text);
    const std::vector<std::string>* const header = table.next();
    const std::size_t columns = header->size();
    const auto row = std::ranges::find(*header, "row") - header->begin();
    std::map<std::string, int> count;
    while (const std::vector<std::string>* const fields = table.next()) {
      EXPECT_EQ(fields->size(), columns) << "line " << table.number();
      ++count[(*fields)[static_cast<std::size_t>(row)]];
    }
    return count;
  }

  // Returns the number of lines below the header.
  [[nodiscard]] int lines_of(const std::string& name) const {
    const std::string text = read_file(file(name));
    return static_cast<int>(std::ranges::count(text, '\n')) - 1;
  }

 private:
  std::string example_;
};

TEST_F(StepsCsvTest, HasTheIterationsOfFormulas) {
  bake("heart");
  touch_twice();
  std::map<std::string, int> count = rows();
  EXPECT_EQ(count["tick"], lines_of("run.csv"));
  EXPECT_GT(count["iteration"], 100);
}

TEST_F(StepsCsvTest, HasMovesPlanesAndTheFeaturesOfFeatureWalks) {
  bake("gem");
  touch_twice();
  std::map<std::string, int> count = rows();
  EXPECT_EQ(count["tick"], lines_of("run.csv"));
  EXPECT_GT(count["move"], count["tick"]);
  EXPECT_GT(count["plane"], 100);
  EXPECT_GT(count["feature"], 100);
}

TEST_F(StepsCsvTest, ASimulationAndItsReplayExplainTheSameAndHashAsWithout) {
  bake("ramp");
  run("sim scene.tactus --seconds 2 --hashes plain.txt");
  run("sim scene.tactus --seconds 2 --hashes hashes.txt --record run.mcap --explain steps.csv");
  EXPECT_EQ(read_file(file("hashes.txt")), read_file(file("plain.txt")));
  EXPECT_EQ(rows()["tick"], lines_of("hashes.txt"));
  const std::string in_simulation = read_file(file("steps.csv"));
  const testing::Outcome replayed =
      testing::run_program(folder(), "replay run.mcap --explain steps.csv");
  EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
  EXPECT_NE(replayed.output.find("2000 recorded explanations: all equal"), std::string::npos)
      << replayed.output;
  EXPECT_EQ(read_file(file("steps.csv")), in_simulation);
}

// The times are those of this machine, so nothing is said about how long a step takes.
TEST_F(StepsCsvTest, HasTheTimesOfTheSevenStepsInASimulationOnly) {
  constexpr std::string_view kTimes =
      "read_ns,tool_ns,collision_ns,proxy_ns,force_ns,command_ns,objects_ns";
  bake("ramp");
  const auto times_of_last_tick = [this] {
    const std::string text = read_file(file("steps.csv"));
    CsvText table(text);
    std::vector<std::string> last;
    while (const std::vector<std::string>* const fields = table.next()) {
      last = *fields;
    }
    return std::vector<std::string>(last.end() - 7, last.end());
  };
  run("sim scene.tactus --seconds 1 --explain steps.csv");
  const std::string text = read_file(file("steps.csv"));
  EXPECT_TRUE(text.substr(0, text.find('\n')).ends_with(kTimes));
  EXPECT_EQ(std::ranges::count(times_of_last_tick(), std::string{}), 0);
  run("sim scene.tactus --seconds 1 --record run.mcap");
  run("replay run.mcap --explain steps.csv");
  EXPECT_EQ(std::ranges::count(times_of_last_tick(), std::string{}), 7);
}

TEST_F(StepsCsvTest, TickIsDrawnByItsNumberItsTimeAndTheMostMoves) {
  bake("gem");
  touch_twice();
  const std::string plot = "plot steps.csv --explain --scene scene.tactus ";
  run(plot + "--tick 870");
  EXPECT_EQ(testing::png_size(file("steps_tick870.png")).width, 1800U);
  std::filesystem::remove(file("steps_tick870.png"));
  run(plot + "--time 3.48");
  EXPECT_TRUE(std::filesystem::exists(file("steps_tick870.png")));
  std::filesystem::remove(file("steps_tick870.png"));
  run(plot + "--worst");
  EXPECT_TRUE(std::filesystem::exists(file("steps_tick870.png")));
  const testing::Outcome missing = testing::run_program(folder(), plot + "--tick 99999");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.output.find("no tick 99999; it has the ticks 0 to 1460"), std::string::npos)
      << missing.output;
  const testing::Outcome foreign =
      testing::run_program(folder(), "plot run.csv --explain --scene scene.tactus");
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.output.find("--explain of tactus touch"), std::string::npos) << foreign.output;
}

}  // namespace
}  // namespace tactus::host
