// Takes the text of a table apart: lines, fields and numbers as Europe, Excel and R write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// Gives out the rows of a text as fields. A blank line is skipped, and so are a byte-order mark and
// a first line `sep=;`. Lines end with a line feed, with a carriage return before it, or with a
// carriage return alone. Fields may be in double quotes.
class CsvText {
 public:
  // Finds the separator from the first line: the one that `sep=` names, else a semicolon, comma or
  // tab outside of quotes, the first of these that the line has. `text` must outlive this.
  explicit CsvText(std::string_view text);

  // Returns the fields of the next row without quotes and the blanks around them; nullptr at the
  // end. They are valid until the next call. Throws InputError, without file and line, for quotes
  // that do not end in their line.
  const std::vector<std::string>* next();

  // Returns the number of the row's line, counted from 1 over all lines.
  [[nodiscard]] std::size_t number() const { return number_; }
  // Returns the row's line as it is.
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] char separator() const { return separator_; }

 private:
  // Goes to the next line that is not blank. Returns false at the end.
  bool next_line();
  // Reads the field at the front of `rest`, and takes it off with the separator after it. Returns
  // false if it is the last one.
  bool next_field(std::string_view& rest, std::string& field) const;

  std::string_view rest_;
  std::string_view line_;
  char line_end_ = '\n';
  char separator_ = ',';
  std::size_t number_ = 0;
  // True while the first line is read, but not given out.
  bool holds_first_ = false;
  std::vector<std::string> fields_;
};

// The mark before the fraction of a number.
enum class DecimalMark { none, point, comma };

// The number of a field and its mark.
struct CsvNumber {
  double value = 0.0;
  DecimalMark mark = DecimalMark::none;
};

// Returns the finite number that makes up the whole field, whatever the locale; nothing if there is
// none. A plus may stand before it, and a comma in place of the point.
std::optional<CsvNumber> csv_number(const std::string& field);

}  // namespace tactus::host
