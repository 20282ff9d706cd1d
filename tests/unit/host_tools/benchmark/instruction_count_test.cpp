#include "host_tools/benchmark/instruction_count.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "host_tools/programs/external_program.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

TEST(InstructionCount, TakesOneTotalForEveryPartThatCountedAnything) {
  std::istringstream file(
      "# callgrind format\npart: 1\nsummary: 0\ntotals: 0\npart: 2\nfn=(1) touch\n16 900\n"
      "totals: 900\n\npart: 3\ntotals: 1234\n");
  EXPECT_EQ(totals_of(file), (std::vector<double>{900.0, 1234.0}));
}

TEST(InstructionCount, IsTheSameInEveryRunOfTheProgram) {
  if (!command_succeeds("command -v valgrind")) {
    GTEST_SKIP() << "valgrind is not installed";
  }
  const testing::TemporaryFolder folder;
  const auto box = folder.write("tetrahedron.off",
                                "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto counts = [&](const std::string& name) {
    const auto file = folder.path() / name;
    EXPECT_TRUE(command_succeeds(shell_quoted(testing::built_program("tactus")) +
                                 " bench touch --ticks 50 --radius-m 0.002 "
                                 "--instructions --mesh " +
                                 shell_quoted(box) + " --csv " + shell_quoted(file)));
    std::string text = read_file(file);
    std::string row = text.substr(text.find("\ntetrahedron,4,2,1,50,") + 1);
    row.resize(row.find('\n'));
    for (int field = 0; field < 11; ++field) {
      row.erase(0, row.find(',') + 1);
    }
    return row;
  };
  const std::string row = counts("first.csv");
  EXPECT_GT(std::stod(row), 100.0) << row;
  EXPECT_EQ(row, counts("second.csv"));
}

}  // namespace
}  // namespace tactus::host
