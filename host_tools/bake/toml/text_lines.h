// Steps through the lines and words of a text and counts the lines, for error messages. Readers of
// text formats use it.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tactus::host {

// The characters that separate words.
inline constexpr std::string_view kBlanks = " \t\r\v\f";

// Takes the next word off the front of `line` and returns it; empty at the end of the line.
inline std::string_view next_word(std::string_view& line) {
  const std::size_t begin = line.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = line.find_first_of(kBlanks, begin);
  const std::string_view word = line.substr(begin, end - begin);
  line = end == std::string_view::npos ? std::string_view{} : line.substr(end);
  return word;
}

// Returns the number that makes up the whole word, or nothing. "nan", "inf" and a leading plus are
// accepted.
template <class Number>
std::optional<Number> to_number(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
  }
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc{} || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

// Gives out the lines of a text, which must outlive it.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  // Returns the next line without its line end; nothing after the last one.
  std::optional<std::string_view> next() {
    if (rest_.empty()) {
      return std::nullopt;
    }
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++number_;
    return line;
  }

  // Returns the next line that has a word outside of a comment, without its comment; '\0' for a
  // format without comments.
  std::optional<std::string_view> next_with_content(char comment) {
    while (std::optional<std::string_view> line = next()) {
      line = line->substr(0, line->find(comment));
      if (line->find_first_not_of(kBlanks) != std::string_view::npos) {
        return line;
      }
    }
    return std::nullopt;
  }

  // Returns the number of the line that was given out last; the first line has number 1.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

}  // namespace tactus::host
