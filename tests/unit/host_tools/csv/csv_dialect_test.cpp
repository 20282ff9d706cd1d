#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using namespace std::string_view_literals;
using testing::TemporaryFolder;

constexpr std::array<std::string_view, 2> kTimeAndX = {"t_s", "x_m"};

CsvTable read_text(std::string_view text) {
  const TemporaryFolder folder;
  return CsvTable::read(folder.write("a.csv", text), kTimeAndX);
}

// Returns the message for the user, without the folder.
std::string csv_error(std::string_view text) {
  const TemporaryFolder folder;
  const std::string message =
      testing::input_error([&] { CsvTable::read(folder.write("a.csv", text), kTimeAndX); });
  return message.substr(std::min(message.size(), folder.path().string().size() + 1));
}

TEST(CsvDialect, ReadsTheSameTableInEveryDialect) {
  for (const std::string_view text :
       {"t_s,x_m\n0.5,-2\n1.5,0.25\n"sv, "t_s;x_m\n0.5;-2\n1.5;0.25\n"sv,
        "t_s;x_m\n0,5;-2\n1,5;0,25\n"sv, "t_s\tx_m\n0,5\t-2\n1,5\t0,25\n"sv,
        "\"t_s\",\"x_m\"\n\"0.5\",\"-2\"\n1.5,0.25\n"sv,
        "\"t_s\";\"x_m\"\n0,5;-2\n1,5;\"0,25\"\n"sv, "sep=;\nt_s;x_m\n0,5;-2\n1,5;0,25\n"sv,
        "t_s,x_m\n+0.5,-2\n+1.5,+0.25\n"sv, "t_s,x_m\r0.5,-2\r1.5,0.25\r"sv,
        "\xEF\xBB\xBF\"t_s\",\"x_m\"\r\n0.5,-2\r\n1.5,0.25\r\n"sv,
        "t_s;note;x_m\n0,5;\"a;b \"\"c\"\"\";-2\n1,5;;0,25\n"sv,
        "t_s,x_m\n\"0,5\",-2\n\"1,5\",\"0,25\"\n"sv, "t_s \t x_m\n0.5\t -2 \n\n1.5\t0.25"sv}) {
    SCOPED_TRACE(text);
    const CsvTable table = read_text(text);
    ASSERT_EQ(table.rows(), 2U);
    EXPECT_EQ(table.column("t_s")[0], 0.5);
    EXPECT_EQ(table.column("x_m")[0], -2.0);
    EXPECT_EQ(table.column("t_s")[1], 1.5);
    EXPECT_EQ(table.column("x_m")[1], 0.25);
  }
}

TEST(CsvDialect, KeepsEmptyFieldsBetweenTabs) {
  EXPECT_EQ(read_text("t_s\tnote\tx_m\n1\t\t2\n").column("x_m")[0], 2.0);
  EXPECT_EQ(csv_error("t_s\tx_m\n1\t\n"), "a.csv:2: column x_m: '' is not a finite number");
}

TEST(CsvDialect, NamesTheRemedyWithTheLine) {
  EXPECT_EQ(csv_error("t_s,x_m\n0,5,1,5\n"),
            "a.csv:2: 4 fields, but the header names 2; where commas are decimal, separate the "
            "columns by semicolons");
  EXPECT_EQ(csv_error("t_s;x_m\n0.5;1\n0,5;1\n"),
            "a.csv:3: column t_s: '0,5' has a decimal comma, but line 2 has decimal points; write "
            "one of them");
  EXPECT_EQ(csv_error("t_s;x_m\n1;1.000,5\n"),
            "a.csv:2: column x_m: '1.000,5' is not a finite number");
  EXPECT_EQ(
      csv_error("t_s x_m\n0 1\n"),
      "a.csv:1: no column t_s; the header is: t_s x_m; separate columns by commas, semicolons "
      "or tabs");
  EXPECT_EQ(
      csv_error("\"t_s\",\"x_m\"\n\"1\",0,1\n"),
      "a.csv:2: 3 fields, but the header names 2; if these are row names of R, write the table "
      "with row.names = FALSE");
  EXPECT_EQ(csv_error("t_s,x_m\n1,\"2\n3,4\n"), "a.csv:2: quotes do not end in their line");
}

TEST(CsvDialect, NamesAFileThatIsNoTable) {
  EXPECT_EQ(csv_error("\xff\xfet\0_\0s\0"sv), "a.csv: this file is UTF-16 text; save it as UTF-8");
  EXPECT_EQ(csv_error("PK\x03\x04"sv),
            "a.csv: this file is a compressed archive or a spreadsheet; unpack it, or save it as "
            "plain text");
  EXPECT_EQ(
      csv_error("<!DOCTYPE html>\n"),
      "a.csv: this file is a web page and not the file itself; download the file that the page "
      "links to");
}

}  // namespace
}  // namespace tactus::host
