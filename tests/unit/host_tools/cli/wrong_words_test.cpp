// Words on the command line that tactus does not know, as a user meets them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "firmware/safety/faults.h"
#include "tests/support/folder_test.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

using testing::run_program;

class WrongWords : public FolderTest {
 protected:
  // Runs tactus, which must refuse the words, and returns what it says.
  [[nodiscard]] std::string said(const std::string& words) const {
    const testing::Outcome outcome = run_program(folder(), words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    return outcome.output;
  }
};

TEST_F(WrongWords, AVerbThatIsNearlyOneIsGuessed) {
  EXPECT_EQ(
      said("inspekt"),
      "tactus: there is no verb 'inspekt'; did you mean 'inspect'? tactus --help lists them\n");
  EXPECT_NE(said("bnch").find("did you mean 'bench'?"), std::string::npos);
}

TEST_F(WrongWords, AVerbThatIsNearNoneIsNotGuessed) {
  EXPECT_EQ(said("haptics"), "tactus: there is no verb 'haptics'; tactus --help lists them\n");
}

TEST_F(WrongWords, AnOptionThatIsNearlyOneIsGuessed) {
  EXPECT_NE(said("sim scene.tactus --secnds 4").find("did you mean '--seconds'?"),
            std::string::npos);
  EXPECT_NE(said("bake scene.toml --jsn").find("did you mean '--json'?"), std::string::npos);
  EXPECT_EQ(said("bake scene.toml --colour-of-night").find("did you mean"), std::string::npos);
}

TEST_F(WrongWords, TheFaultsAreThereForPrograms) {
  const testing::Outcome outcome = run_program(folder(), "faults --json");
  ASSERT_EQ(outcome.exit_code, 0);
  const nlohmann::json faults = nlohmann::json::parse(outcome.output);
  ASSERT_EQ(faults.size(), firmware::kFaultTexts.size());
  EXPECT_EQ(faults[0]["name"], firmware::kFaultTexts[0].name);
  EXPECT_EQ(faults[0]["recovery"], firmware::kFaultTexts[0].recovery);
}

}  // namespace
}  // namespace tactus::host
