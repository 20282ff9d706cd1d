#include "host_tools/csv/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using Fields = std::vector<std::string_view>;

// Returns the text without blanks at either end. A carriage return counts as blank, so files of
// Windows are read as well.
std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Puts the fields of a line into `fields`, without the blanks around them.
void split(std::string_view line, Fields& fields) {
  fields.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return;
    }
    line.remove_prefix(comma + 1);
  }
}

// Gives out the lines of a text that are not blank, each with its number, counted from 1 over all
// lines.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.starts_with(kByteOrderMark)) {
      rest_.remove_prefix(kByteOrderMark.size());
    }
  }

  // Returns the next line that is not blank; nothing at the end.
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      const std::string_view line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      if (!line.empty()) {
        return line;
      }
    }
    return std::nullopt;
  }

  // Returns the number of the line that next() has returned.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

// Returns the number that makes up the whole field; std::from_chars ignores the locale, so that the
// decimal point is a point everywhere.
std::optional<double> finite_number(std::string_view field) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

// The place of a requested column in a row, and the vector that its values go to.
struct Place {
  std::size_t field = 0;
  std::vector<double>* values = nullptr;
  std::string_view name;
};

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file,
                        std::span<const std::string_view> required,
                        std::span<const std::string_view> optional) {
  const std::string shown = file.string();
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(fmt::format("{}: no such file, or not readable", shown));
  }
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string text = content.str();
  Lines lines(text);
  Fields fields;
  const std::optional<std::string_view> header = lines.next();
  if (!header) {
    throw InputError(fmt::format("{}: empty; the first line must name the columns", shown));
  }
  split(*header, fields);

  CsvTable table;
  std::vector<Place> places;
  for (const std::span<const std::string_view> names : {required, optional}) {
    for (const std::string_view name : names) {
      const auto found = std::ranges::find(fields, name);
      if (found == fields.end()) {
        if (names.data() == required.data()) {
          throw InputError(fmt::format("{}:{}: no column {}; the header is: {}", shown,
                                       lines.number(), name, *header));
        }
        continue;
      }
      if (std::find(found + 1, fields.end(), name) != fields.end()) {
        throw InputError(fmt::format("{}:{}: column {} stands twice", shown, lines.number(), name));
      }
      std::vector<double>& values = table.columns_[std::string(name)];
      places.push_back({.field = static_cast<std::size_t>(found - fields.begin()),
                        .values = &values,
                        .name = name});
    }
  }

  const std::size_t width = fields.size();
  while (const std::optional<std::string_view> line = lines.next()) {
    split(*line, fields);
    if (fields.size() != width) {
      throw InputError(fmt::format("{}:{}: {} fields, but the header names {}", shown,
                                   lines.number(), fields.size(), width));
    }
    for (const Place& place : places) {
      const std::optional<double> value = finite_number(fields[place.field]);
      if (!value) {
        throw InputError(fmt::format("{}:{}: column {}: '{}' is not a finite number", shown,
                                     lines.number(), place.name, fields[place.field]));
      }
      place.values->push_back(*value);
    }
    table.lines_.push_back(lines.number());
  }
  if (table.rows() == 0) {
    throw InputError(fmt::format("{}: no rows below the header", shown));
  }
  return table;
}

std::span<const double> CsvTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  return found == columns_.end() ? std::span<const double>{}
                                 : std::span<const double>(found->second);
}

}  // namespace tactus::host
