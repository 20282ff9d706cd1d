#include "host_tools/benchmark/figures_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "host_tools/files/atomic_file.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::TemporaryFolder;

const TouchFigures kFigures{.mesh = "ball",
                            .triangles = 20,
                            .radius_m = 0.002,
                            .motion = "hand",
                            .timing = {.ticks = 7, .median_ns = 400.4, .flagged_ticks = 3},
                            .lateness = {.late_ticks = 7,
                                         .worst_m = 8e-5,
                                         .worst_turn_rad = std::numbers::pi / 2.0,
                                         .in_a_row = 4,
                                         .turned_ticks = 2}};

TEST(FiguresFile, NamesItsColumnsOnceAndTheMachineOncePerRun) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "figures.csv";
  {
    FiguresFile first(path);
    first.append(kFigures);
    first.append(kFigures);
  }
  FiguresFile(path).append(kFigures);
  const std::string text = read_file(path);
  EXPECT_TRUE(text.starts_with("mesh,triangles,"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 1 + 2 + 1 + 1);
  EXPECT_EQ(std::ranges::count(text, '#'), 2);
  EXPECT_TRUE(
      contains(text, "\nball,20,2,1,7,400,0,0,0,0,0,,,,,,0,3,0,hand,7,80.0,90.0,4,2,,,,\n"));
}

TEST(FiguresFile, EveryRowHasAFieldForEveryColumn) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "figures.csv";
  FiguresFile file(path);
  TouchFigures counted = kFigures;
  counted.instructions = InstructionCount{.mean = 1.0, .median = 2.0, .max = 3.0};
  counted.paced = SingleTimes{.median_ns = 900.0, .p999_ns = 4000.0};
  counted.cold = counted.paced;
  file.append(kFigures);
  file.append(counted);
  const std::string text = read_file(path);
  const auto commas = std::ranges::count(text.substr(0, text.find('\n')), ',');
  std::size_t line = text.find("\nball");
  while (line != std::string::npos) {
    const std::size_t end = text.find('\n', line + 1);
    EXPECT_EQ(std::ranges::count(text.substr(line, end - line), ','), commas);
    line = text.find("\nball", end);
  }
}

TEST(FiguresFile, RefusesAFileWithOtherColumns) {
  const TemporaryFolder folder;
  const auto path = folder.write("table.csv", "a,b\n1,2\n");
  EXPECT_TRUE(contains(testing::input_error([&] { FiguresFile{path}; }), "table.csv:1: "));
  EXPECT_EQ(read_file(path), "a,b\n1,2\n");
}

TEST(FiguresFile, SaysWhenItCannotBeWritten) {
  EXPECT_TRUE(contains(testing::input_error([] { FiguresFile{"/no/such/folder/figures.csv"}; }),
                       "/no/such/folder/figures.csv: cannot be written"));
}

TEST(DescribeMachine, NamesTheCompilerAndItsFlags) {
  EXPECT_TRUE(contains(describe_machine(), "-ffp-contract=off"));
  EXPECT_EQ(describe_machine().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace tactus::host
