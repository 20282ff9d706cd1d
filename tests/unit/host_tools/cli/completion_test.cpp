// `tactus complete`: what a shell offers for the last word.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

std::vector<std::string> offered_after(const std::string& words) {
  const testing::Outcome outcome =
      testing::run_program(std::filesystem::temp_directory_path(), "complete " + words);
  EXPECT_EQ(outcome.exit_code, 0) << words;
  std::istringstream lines(outcome.output);
  std::vector<std::string> offered;
  for (std::string line; std::getline(lines, line);) {
    offered.push_back(line);
  }
  return offered;
}

using Words = std::vector<std::string>;

TEST(Completion, OffersTheVerbsThatBeginAsTheWord) {
  EXPECT_EQ(offered_after("be"), Words{"bench"});
  EXPECT_EQ(offered_after("emulate o"), Words{"odrive"});
  EXPECT_GT(offered_after("''").size(), 20U);
  EXPECT_EQ(offered_after("''"), offered_after(""));
}

TEST(Completion, OffersTheOptionsOfTheVerb) {
  EXPECT_EQ(offered_after("bake --"), (Words{"--help", "--output", "--json", "--quiet"}));
  EXPECT_EQ(offered_after("emulate odrive --can vcan0 --nod"), Words{"--nodes"});
}

TEST(Completion, OffersTheValuesThatAnOptionOrAnArgumentAdmits) {
  EXPECT_EQ(offered_after("record ''"), (Words{"on", "off"}));
  EXPECT_EQ(offered_after("emulate moteus --timeout-mode ''"), (Words{"0", "12"}));
  EXPECT_EQ(offered_after("plot run.csv --format ''"), (Words{"png", "svg", "pdf"}));
}

TEST(Completion, OffersTheValuesThatADescriptionLists) {
  EXPECT_EQ(offered_after("friction --experiment ''"),
            (Words{"presliding", "lag", "break-away", "stick-slip", "hunting", "hysteresis"}));
  // In brackets after a value stands its meaning.
  EXPECT_EQ(offered_after("emulate odrive --encoder ''"),
            (Words{"incremental", "absolute", "multi_turn"}));
  EXPECT_EQ(offered_after("emulate odrive --hand f"), (Words{"finger", "firm"}));
  EXPECT_EQ(offered_after("compare --methods one_plane,three"),
            (Words{"one_plane,three_sub_goals", "one_plane,three_step"}));
  EXPECT_EQ(offered_after("compare --friction dahl,lu"), Words{"dahl,lugre"});
}

TEST(Completion, TakesAnOptionThatTheShellHasCutAtItsEqualsSign) {
  EXPECT_EQ(offered_after("friction --model = lu"), Words{"lugre"});
  EXPECT_EQ(offered_after("friction --model ="), offered_after("friction --model ''"));
}

TEST(Completion, AddsToTheValuesBeforeAComma) {
  EXPECT_EQ(offered_after("sim --hand pen,fi"), (Words{"pen,finger", "pen,firm"}));
}

TEST(Completion, LeavesFileNamesNumbersAndUnknownWordsToTheShell) {
  EXPECT_EQ(offered_after("bake sce"), Words{});
  EXPECT_EQ(offered_after("bench --runs ''"), Words{});
  EXPECT_EQ(offered_after("no_verb ''"), Words{});
  // A sentence that names three kinds of files lists no values.
  EXPECT_EQ(offered_after("friction --figure ''"), Words{});
}

}  // namespace
}  // namespace tactus::host
