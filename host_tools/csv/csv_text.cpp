#include "host_tools/csv/csv_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "host_tools/files/foreign_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::string_view kBlank = " \t\r";

// Returns the text without the characters of `blank` at either end.
std::string_view trimmed(std::string_view text, std::string_view blank) {
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Returns the separator of a line: the first of semicolon, comma and tab that it has outside of
// quotes.
char separator_of(std::string_view line) {
  constexpr std::string_view kSeparators = ";,\t";
  std::size_t best = kSeparators.size();
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    const std::size_t rank = kSeparators.find(c);
    if (!quoted && rank < best) {
      best = rank;
    }
  }
  return best == kSeparators.size() ? ',' : kSeparators[best];
}

}  // namespace

CsvText::CsvText(std::string_view text) : rest_(without_byte_order_mark(text)) {
  if (rest_.find('\n') == std::string_view::npos) {
    line_end_ = '\r';
  }
  constexpr std::string_view kExcel = "sep=";
  if (!next_line()) {
    return;
  }
  const std::string_view named = trimmed(line_, "\r");
  if (named.starts_with(kExcel) && named.size() == kExcel.size() + 1) {
    separator_ = named.back();
    return;
  }
  separator_ = separator_of(line_);
  holds_first_ = true;
}

bool CsvText::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find(line_end_);
    line_ = trimmed(rest_.substr(0, end), "\r");
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    if (!trimmed(line_, kBlank).empty()) {
      return true;
    }
  }
  return false;
}

bool CsvText::next_field(std::string_view& rest, std::string& field) const {
  const std::string_view blank = separator_ == '\t' ? " " : " \t";
  std::size_t place = rest.find_first_not_of(blank);
  field.clear();
  if (place != std::string_view::npos && rest[place] == '"') {
    // Two quotes within quotes stand for one.
    for (++place; place < rest.size(); ++place) {
      const bool is_quote = rest[place] == '"';
      const bool is_pair = is_quote && place + 1 < rest.size() && rest[place + 1] == '"';
      if (is_quote && !is_pair) {
        break;
      }
      place += is_pair ? 1 : 0;
      field += rest[place];
    }
    if (place >= rest.size()) {
      throw InputError("quotes do not end in their line");
    }
    rest.remove_prefix(place + 1);
  }
  const std::size_t end = rest.find(separator_);
  field += trimmed(rest.substr(0, end), blank);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return end != std::string_view::npos;
}

const std::vector<std::string>* CsvText::next() {
  if (!holds_first_ && !next_line()) {
    return nullptr;
  }
  holds_first_ = false;
  std::string_view rest = line_;
  std::size_t count = 0;
  bool more = true;
  while (more) {
    if (count == fields_.size()) {
      fields_.emplace_back();
    }
    more = next_field(rest, fields_[count++]);
  }
  fields_.resize(count);
  return &fields_;
}

std::optional<CsvNumber> csv_number(const std::string& field) {
  CsvNumber number;
  std::string text = field.starts_with('+') ? field.substr(1) : field;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) {
    if (text.find('.') != std::string::npos) {
      return std::nullopt;
    }
    number.mark = DecimalMark::comma;
    text[comma] = '.';
  } else if (text.find('.') != std::string::npos) {
    number.mark = DecimalMark::point;
  }
  // std::from_chars ignores the locale.
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number.value);
  if (error != std::errc{} || end != last || !std::isfinite(number.value)) {
    return std::nullopt;
  }
  return number;
}

}  // namespace tactus::host
