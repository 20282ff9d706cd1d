// The page "It buzzes, it will not open, it pulls" names commands, fields, parameters and faults:
// all of them exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/control/parameter_name.h"
#include "firmware/safety/faults.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/recording/record_columns.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class Troubleshooting : public FolderTest {
 protected:
  // Returns what matches the pattern's first group, each once.
  [[nodiscard]] std::vector<std::string> all(const std::string& pattern) const {
    std::vector<std::string> found;
    const std::regex expression(pattern);
    for (std::sregex_iterator i(page_.begin(), page_.end(), expression), end; i != end; ++i) {
      found.push_back((*i)[1].str());
    }
    std::ranges::sort(found);
    found.erase(std::ranges::unique(found).begin(), found.end());
    return found;
  }

  const std::string page_ = read_file(testing::in_repository("firmware/TROUBLESHOOTING.md"));
};

TEST_F(Troubleshooting, EveryCommandIsOneAndHasItsOptions) {
  const std::vector<std::string> commands = all("(?:`|\n)(tactusd? (?:[a-z-]|-[^`\n])[^`\n#]*)");
  ASSERT_GT(commands.size(), 15U);
  for (const std::string& command : commands) {
    std::smatch parts;
    ASSERT_TRUE(std::regex_search(command, parts, std::regex("^(tactusd?) ([a-z]*)")));
    const std::string program = testing::built_program(parts[1].str());
    if (!std::filesystem::exists(program)) {
      continue;  // tactusd needs libraries that are not everywhere
    }
    const testing::Outcome help =
        testing::run_command(folder(), "'" + program + "' " + parts[2].str() + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    const std::regex option("--[a-z-]+");
    for (std::sregex_iterator i(command.begin(), command.end(), option), end; i != end; ++i) {
      EXPECT_NE(help.output.find(i->str()), std::string::npos) << command;
    }
  }
}

TEST_F(Troubleshooting, EveryFieldIsOne) {
  for (const std::string& fields : all("--fields ([a-z_,]+)")) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= fields.size();) {
      const std::size_t end = std::min(fields.find(',', begin), fields.size());
      names.push_back(fields.substr(begin, end - begin));
      begin = end + 1;
    }
    EXPECT_NO_THROW(chosen_columns(names, 3)) << fields;
  }
}

TEST_F(Troubleshooting, EveryParameterIsOne) {
  const std::vector<std::string> names = all("tactus set ([^ `]+)");
  EXPECT_GT(names.size(), 2U);
  for (const std::string& name : names) {
    EXPECT_TRUE(firmware::parse_parameter_name(name)) << name;
  }
}

TEST_F(Troubleshooting, EveryFaultIsOne) {
  const std::string stops = page_.substr(page_.find("## It stops"));
  const std::regex name("`([a-z_]+)`[,| ]");
  std::size_t count = 0;
  for (std::sregex_iterator i(stops.begin(), stops.end(), name), end; i != end; ++i) {
    const std::string word = (*i)[1].str();
    if (word == "counts_per_turn") {
      continue;
    }
    ++count;
    EXPECT_TRUE(std::ranges::any_of(firmware::kFaultTexts, [&](const firmware::FaultText& text) {
      return text.name == word;
    })) << word;
  }
  EXPECT_GT(count, 8U);
}

}  // namespace
}  // namespace tactus::host
