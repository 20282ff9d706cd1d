#include "host_tools/csv/csv_table.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 2> kTwoColumns = {"t_s", "x_m"};

std::string csv_file_with(std::string_view text) {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = ::testing::TempDir() + "tactus_" + test->name() + ".csv";
  std::ofstream(name, std::ios::binary) << text;
  return name;
}

// Returns the message for the user, without the folder.
std::string complaint(std::string_view text) {
  const std::string name = csv_file_with(text);
  try {
    CsvTable::read(name, kTwoColumns);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.starts_with(name) ? name.size() : 0);
  }
  return "accepted";
}

TEST(CsvTable, FindsColumnsByNameInAnyOrder) {
  const CsvTable table =
      CsvTable::read(csv_file_with("x_m,note,t_s\n0.5,hello,1\n-2e-3,,2\n"), kTwoColumns);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.column("t_s")[1], 2.0);
  EXPECT_EQ(table.column("x_m")[1], -2e-3);
  EXPECT_EQ(table.line(1), 3U);
}

TEST(CsvTable, TakesBlanksCarriageReturnsBlankLinesAndAByteOrderMark) {
  const CsvTable table =
      CsvTable::read(csv_file_with("\xEF\xBB\xBFt_s , x_m\r\n\r\n 1 , 2 \r\n3,4"), kTwoColumns);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.column("x_m")[1], 4.0);
  EXPECT_EQ(table.line(0), 3U);
}

TEST(CsvTable, OptionalColumnsMayBeMissing) {
  constexpr std::array<std::string_view, 2> kOptional = {"mode", "y_m"};
  const CsvTable table =
      CsvTable::read(csv_file_with("t_s,x_m,y_m\n1,2,3\n"), kTwoColumns, kOptional);
  EXPECT_FALSE(table.has("mode"));
  EXPECT_TRUE(table.column("mode").empty());
  EXPECT_EQ(table.column("y_m")[0], 3.0);
}

TEST(CsvTable, NamesTheLineAndTheColumnOfWhatIsWrong) {
  EXPECT_EQ(complaint(""), ": empty; the first line must name the columns");
  EXPECT_EQ(complaint("t_s,y_m\n1,2\n"), ":1: no column x_m; the header is: t_s,y_m");
  EXPECT_EQ(complaint("t_s,x_m,x_m\n1,2,3\n"), ":1: column x_m stands twice");
  EXPECT_EQ(complaint("t_s,x_m\n1,2\n3\n"), ":3: 1 fields, but the header names 2");
  EXPECT_EQ(complaint("t_s,x_m\n1,abc\n"), ":2: column x_m: 'abc' is not a finite number");
  EXPECT_EQ(complaint("t_s,x_m\n1,nan\n"), ":2: column x_m: 'nan' is not a finite number");
  EXPECT_EQ(complaint("t_s,x_m\n1,\n"), ":2: column x_m: '' is not a finite number");
  EXPECT_EQ(complaint("t_s,x_m\n1,1e999\n"), ":2: column x_m: '1e999' is not a finite number");
  EXPECT_EQ(complaint("t_s,x_m\n"), ": no rows below the header");
}

TEST(CsvTable, AMissingFileIsSaidToBeMissing) {
  try {
    CsvTable::read("/no/such/file.csv", kTwoColumns);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "/no/such/file.csv: no such file, or not readable");
  }
}

}  // namespace
}  // namespace tactus::host
