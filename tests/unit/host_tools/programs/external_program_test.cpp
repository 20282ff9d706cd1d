#include "host_tools/programs/external_program.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {
namespace {

TEST(ExternalProgram, HandsOverEachLineAndTheExitCode) {
  std::vector<std::string> lines;
  const int code = run_lines("printf 'one\\n\\nthree'; exit 7",
                             [&](std::string_view line) { lines.emplace_back(line); });
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "", "three"}));
  EXPECT_EQ(code, 7);
}

TEST(ExternalProgram, HandsOverALineThatIsLongerThanItsBuffer) {
  std::vector<std::string> lines;
  const int code = run_lines("head -c 10000 /dev/zero | tr '\\0' x; echo; echo end",
                             [&](std::string_view line) { lines.emplace_back(line); });
  EXPECT_EQ(lines, (std::vector<std::string>{std::string(10000, 'x'), "end"}));
  EXPECT_EQ(code, 0);
}

TEST(ExternalProgram, TellsAProgramThatASignalEnded) {
  EXPECT_EQ(run_lines("kill -KILL $$", [](std::string_view) {}), -1);
}

TEST(ExternalProgram, QuotesAWordForAShell) {
  const std::string word = "it's $HOME; `id` \"x\"";
  std::string printed;
  run_lines("printf %s " + shell_quoted(word), [&](std::string_view line) { printed = line; });
  EXPECT_EQ(printed, word);
}

}  // namespace
}  // namespace tactus::host
