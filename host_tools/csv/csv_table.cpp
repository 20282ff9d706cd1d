#include "host_tools/csv/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "host_tools/csv/csv_text.h"
#include "host_tools/files/foreign_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(fmt::format("{}: no such file, or not readable", file.string()));
  }
  std::ostringstream content;
  content << stream.rdbuf();
  std::string text = content.str();
  const std::string_view complaint = foreign_content(text, "");
  if (!complaint.empty()) {
    throw InputError(fmt::format("{}: this file {}", file.string(), complaint));
  }
  return text;
}

}  // namespace

std::string csv_heading(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string heading;
  std::getline(stream, heading);
  return heading;
}

// Reads one file into a table.
class CsvTable::Reader {
 public:
  Reader(const std::filesystem::path& file, CsvTable& table)
      : file_(file.string()), text_(content_of(file)), rows_(text_), table_(table) {}

  void read(std::span<const std::string_view> required, std::span<const std::string_view> optional,
            std::span<const CsvWords> words) {
    const std::vector<std::string>* header = next_row();
    if (header == nullptr) {
      throw InputError(fmt::format("{}: empty; the first line must name the columns", file_));
    }
    find_columns(*header, required, true);
    find_columns(*header, optional, false);
    for (const CsvWords& known : words) {
      for (Place& place : places_) {
        place.words = place.name == known.column ? known.words : place.words;
      }
    }
    width_ = header->size();
    while (const std::vector<std::string>* row = next_row()) {
      read_row(*row);
    }
    if (table_.rows() == 0) {
      throw InputError(fmt::format("{}: no rows below the header", file_));
    }
  }

 private:
  // The place of a requested column in a row, and the vector that its values go to.
  struct Place {
    std::size_t field = 0;
    std::vector<double>* values = nullptr;
    std::string_view name;
    // The words that stand for the numbers from 0 on.
    std::span<const std::string_view> words;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, rows_.number(), what));
  }

  const std::vector<std::string>* next_row() {
    try {
      return rows_.next();
    } catch (const InputError& error) {
      fail(error.what());
    }
  }

  void find_columns(const std::vector<std::string>& header, std::span<const std::string_view> names,
                    bool required) {
    for (const std::string_view name : names) {
      const auto found = std::ranges::find(header, name);
      if (found == header.end()) {
        if (required) {
          fail(fmt::format("no column {}; the header is: {}{}", name, rows_.line(),
                           header.size() == 1 && rows_.line().find(' ') != std::string_view::npos
                               ? "; separate columns by commas, semicolons or tabs"
                               : ""));
        }
        continue;
      }
      if (std::find(found + 1, header.end(), name) != header.end()) {
        fail(fmt::format("column {} stands twice", name));
      }
      places_.push_back({.field = static_cast<std::size_t>(found - header.begin()),
                         .values = &table_.columns_[std::string(name)],
                         .name = name});
    }
  }

  void read_row(const std::vector<std::string>& row) {
    if (row.size() != width_) {
      fail(fmt::format("{} fields, but the header names {}{}", row.size(), width_,
                       advice_on_width(row.size())));
    }
    for (const Place& place : places_) {
      const std::string& field = row[place.field];
      const auto word = std::ranges::find(place.words, field);
      place.values->push_back(word == place.words.end()
                                  ? number_of(field, place.name)
                                  : static_cast<double>(word - place.words.begin()));
    }
    table_.lines_.push_back(rows_.number());
  }

  // Returns the remedy for a row that is longer than the header.
  [[nodiscard]] std::string_view advice_on_width(std::size_t size) const {
    if (table_.rows() == 0 && size == width_ + 1) {
      return "; if these are row names of R, write the table with row.names = FALSE";
    }
    if (size > width_ && rows_.separator() == ',') {
      return "; where commas are decimal, separate the columns by semicolons";
    }
    return "";
  }

  // Returns a field's number. Throws InputError if it is none, or if its decimal mark is another
  // than that of the numbers before: one of them then separates thousands, or two files are mixed.
  double number_of(const std::string& field, std::string_view column) {
    const std::optional<CsvNumber> number = csv_number(field);
    if (!number) {
      fail(fmt::format("column {}: '{}' is not a finite number", column, field));
    }
    if (number->mark != DecimalMark::none && mark_ == DecimalMark::none) {
      mark_ = number->mark;
      mark_line_ = rows_.number();
    } else if (number->mark != DecimalMark::none && number->mark != mark_) {
      fail(
          fmt::format("column {}: '{}' has a decimal {}, but line {} has decimal {}s; write one of "
                      "them",
                      column, field, mark_ == DecimalMark::point ? "comma" : "point", mark_line_,
                      mark_ == DecimalMark::point ? "point" : "comma"));
    }
    return number->value;
  }

  std::string file_;
  std::string text_;
  CsvText rows_;
  CsvTable& table_;
  std::vector<Place> places_;
  std::size_t width_ = 0;
  // The decimal mark of the numbers so far, and the first line that has it.
  DecimalMark mark_ = DecimalMark::none;
  std::size_t mark_line_ = 0;
};

CsvTable CsvTable::read(const std::filesystem::path& file,
                        std::span<const std::string_view> required,
                        std::span<const std::string_view> optional,
                        std::span<const CsvWords> words) {
  CsvTable table;
  Reader(file, table).read(required, optional, words);
  return table;
}

std::span<const double> CsvTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  return found == columns_.end() ? std::span<const double>{}
                                 : std::span<const double>(found->second);
}

}  // namespace tactus::host
