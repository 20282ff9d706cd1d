// Reading a table of numbers from a comma-separated file whose first line names the columns.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// Holds the asked-for columns; others in the file are skipped unread. Rows have line numbers for
// messages.
class CsvTable {
 public:
  // Every name in `required` must be in the header; names in `optional` may be. Throws InputError,
  // one line for a user that names the file, the line and the column, like `path.csv:7: column x_m:
  // 'abc' is not a number`: no such file, no header, a missing or repeated column, a short or long
  // row, a field that is not a finite number, no rows.
  static CsvTable read(const std::filesystem::path& file,
                       std::span<const std::string_view> required,
                       std::span<const std::string_view> optional = {});

  [[nodiscard]] std::size_t rows() const { return lines_.size(); }
  [[nodiscard]] bool has(std::string_view column) const { return columns_.contains(column); }
  // Returns the values of a column; empty if there is no such column.
  [[nodiscard]] std::span<const double> column(std::string_view name) const;
  // The line of the file that row came from, from 1.
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_[row]; }

 private:
  std::map<std::string, std::vector<double>, std::less<>> columns_;
  std::vector<std::size_t> lines_;
};

}  // namespace tactus::host
