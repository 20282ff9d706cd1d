// The tables of verbs and folders in the READMEs are complete.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

const std::filesystem::path kHostTools = testing::in_repository("host_tools");

std::size_t times_in(const std::string& text, const std::string& word) {
  std::size_t times = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++times;
  }
  return times;
}

// Returns the verbs that `tactus --help` lists below "Subcommands:".
std::vector<std::string> verbs_of_the_program() {
  const std::string help =
      testing::run_program(std::filesystem::temp_directory_path(), "--help").output;
  const std::size_t begin = help.find("Subcommands:");
  std::istringstream lines(begin == std::string::npos ? "" : help.substr(begin));
  std::vector<std::string> verbs;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ") && !line.starts_with("   ")) {
      verbs.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return verbs;
}

TEST(CliReadme, ListsEveryVerbOnceAndNoOther) {
  const std::string readme = read_file(kHostTools / "cli" / "README.md");
  const std::size_t begin = readme.find("| verbs |");
  ASSERT_NE(begin, std::string::npos);
  std::istringstream rows(readme.substr(begin, readme.find("\n\n", begin) - begin));
  std::string listed;
  for (std::string row; std::getline(rows, row);) {
    listed += row.substr(0, row.find('|', 1));
  }
  const std::vector<std::string> verbs = verbs_of_the_program();
  EXPECT_GT(verbs.size(), 20U);
  for (const std::string& verb : verbs) {
    EXPECT_EQ(times_in(listed, "`" + verb + "`"), 1U) << verb;
  }
  EXPECT_EQ(times_in(listed, "`"), 2 * verbs.size());
}

TEST(HostToolsReadme, NamesEveryFolder) {
  const std::string readme = read_file(kHostTools / "README.md");
  for (const auto& entry : std::filesystem::directory_iterator(kHostTools)) {
    if (entry.is_directory()) {
      const std::string row = "| `" + entry.path().filename().string() + "/` |";
      EXPECT_EQ(times_in(readme, row), 1U) << row;
    }
  }
}

}  // namespace
}  // namespace tactus::host
