// Reads tables of numbers from text files whose first line names the columns: wish paths, tool
// paths, runs and measurements. The host tools call it; it is for one thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// A column that has words: each stands for its number in the list. Numbers are taken, too.
struct CsvWords {
  std::string_view column;
  std::span<const std::string_view> words;
};

// Returns the first line of a file, without its end; empty if it cannot be read.
std::string csv_heading(const std::filesystem::path& file);

// Holds the requested columns of one file; the others are skipped unread. Every row remembers its
// line in the file, for messages of the caller.
class CsvTable {
 public:
  // Reads a file. Every name in `required` must be in the header; names in `optional` may be.
  // `words` are those of columns among both. The
  // header shows what separates columns: commas, semicolons or tabs. Numbers may have a decimal
  // comma where commas do not separate, and fields may be in quotes. Blank lines and a byte-order
  // mark are skipped. Throws InputError, one line that names the file, the line and the column,
  // like `path.csv:7: column x_m: 'abc' is not a finite number`, for: a missing file, another kind
  // of file, no header, a missing or repeated column, a row with too few or too many fields, a
  // field that is not a finite number, decimal points and commas in one file, and a file without
  // rows.
  static CsvTable read(const std::filesystem::path& file,
                       std::span<const std::string_view> required,
                       std::span<const std::string_view> optional = {},
                       std::span<const CsvWords> words = {});

  // Returns the number of rows below the header, blank lines not counted; at least 1.
  [[nodiscard]] std::size_t rows() const { return lines_.size(); }
  // Returns true if the column was requested and is in the file.
  [[nodiscard]] bool has(std::string_view column) const { return columns_.contains(column); }
  // Returns a column's values in the order of the rows, valid as long as the table; empty if the
  // table has no such column.
  [[nodiscard]] std::span<const double> column(std::string_view name) const;
  // Returns the number of the line in the file that the row came from; the header usually has line
  // 1.
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_[row]; }

 private:
  class Reader;

  std::map<std::string, std::vector<double>, std::less<>> columns_;
  std::vector<std::size_t> lines_;
};

}  // namespace tactus::host
