// A line of text of fixed size, without stdio. One thread; real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// A line that is built from words and numbers. What does not fit is left out.
class Line {
 public:
  Line& add(std::string_view words);
  // Adds a number after a space, decimal.
  Line& add(std::uint64_t number);
  // Adds a number after a space, as 16 hexadecimal digits.
  Line& add_hex(std::uint64_t number);

  [[nodiscard]] std::string_view text() const { return {room_.data(), size_}; }

 private:
  std::array<char, 160> room_{};
  std::size_t size_ = 0;
};

}  // namespace tactus::firmware
