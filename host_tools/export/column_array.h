// The values of some columns of a run, column by column, with the types of numpy. `tactus export`
// writes them as NPZ; the Python module gives them as an array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/recording/record_columns.h"

namespace tactus::host {

// The values of a column: a number's bits for each tick, or a word, which lives as long as the
// program.
class ColumnArray {
 public:
  // Appends the value of a tick, which has the kind of those before.
  void append(const ColumnValue& value);

  // Returns the type in numpy's notation: <f8, <i8, <u8, or <U and the length of the longest word.
  [[nodiscard]] std::string type() const;
  // Returns the bytes of a value of that type.
  [[nodiscard]] std::size_t value_bytes() const;
  // Returns the number of values.
  [[nodiscard]] std::size_t size() const { return numbers_.size() + words_.size(); }
  // Returns the bits of the numbers; empty for words.
  [[nodiscard]] const std::vector<std::uint64_t>& numbers() const { return numbers_; }
  // Returns true if the values are words.
  [[nodiscard]] bool has_words() const { return !words_.empty(); }
  // Returns a word as numpy's text: value_bytes() bytes, four for each character, filled up with
  // zeros.
  [[nodiscard]] std::vector<char32_t> text(std::size_t index) const;

 private:
  std::string_view number_type_ = "<f8";
  std::vector<std::uint64_t> numbers_;
  std::vector<std::string_view> words_;
  std::size_t longest_word_ = 1;
};

}  // namespace tactus::host
