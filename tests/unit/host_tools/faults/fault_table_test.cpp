#include "host_tools/faults/fault_table.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "tests/support/paths.h"

namespace tactus::host {
namespace {

TEST(FaultTable, TheFirmwaresReadmeHasWhatIsGenerated) {
  const std::string readme = read_file(testing::in_repository("firmware/README.md"));
  EXPECT_EQ(with_fault_table(readme), readme)
      << "run: tactus faults --markdown --into firmware/README.md";
}

TEST(FaultTable, ReplacesTheTableAndNothingElse) {
  const std::string table = fault_table_markdown();
  const std::string header = table.substr(0, table.find('\n') + 1);
  EXPECT_EQ(with_fault_table("before\n\n" + header + "| old |\n\nafter\n"),
            "before\n\n" + table + "\nafter\n");
  EXPECT_EQ(with_fault_table(header + "| old |\n"), table);
  EXPECT_THROW(with_fault_table("no table\n"), InputError);
}

TEST(FaultTable, HasARowForEveryCodeInBothForms) {
  const std::string markdown = fault_table_markdown();
  const std::string text = fault_table_text();
  for (const firmware::FaultText& fault : firmware::kFaultTexts) {
    const std::string name(fault.name);
    EXPECT_NE(markdown.find("| " + name + " |"), std::string::npos);
    EXPECT_NE(text.find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace tactus::host
