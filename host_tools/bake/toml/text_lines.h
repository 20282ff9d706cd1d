// Walks through the lines and words of a text, counting lines for error messages.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tactus::host {

inline constexpr std::string_view kBlanks = " \t\r\v\f";

// Takes the next word off the front of `line`; empty at the end.
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

// The whole word as a number, or nothing. Accepts "nan" and "inf" and a leading plus.
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

class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  // The next line, without its end; nothing after the last.
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

  // The next line that has a word outside of a comment, without the comment.
  std::optional<std::string_view> next_with_content(char comment) {
    while (std::optional<std::string_view> line = next()) {
      line = line->substr(0, line->find(comment));
      if (line->find_first_not_of(kBlanks) != std::string_view::npos) {
        return line;
      }
    }
    return std::nullopt;
  }

  // Returns the number of the line given last; the first is 1.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

}  // namespace tactus::host
