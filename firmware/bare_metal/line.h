// A line of text of fixed size, without stdio. One thread; real time.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// A line that is built from words and numbers. What does not fit is left out.
class Line {
 public:
  Line& add(std::string_view words) {
    const std::size_t count = std::min(words.size(), room_.size() - size_);
    std::copy_n(words.begin(), count, room_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  // Adds a number after a space, decimal.
  Line& add(std::uint64_t number) { return add(" ").add_in_base(number, 10); }
  // Adds a number after a space, as 16 hexadecimal digits.
  Line& add_hex(std::uint64_t number) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    add(" ");
    for (int shift = 60; shift >= 0; shift -= 4) {
      add(kDigits.substr((number >> static_cast<unsigned>(shift)) & 15U, 1));
    }
    return *this;
  }

  [[nodiscard]] std::string_view text() const { return {room_.data(), size_}; }

 private:
  Line& add_in_base(std::uint64_t number, int base) {
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), number, base).ptr;
    return add(std::string_view(digits.begin(), end));
  }

  std::array<char, 160> room_{};
  std::size_t size_ = 0;
};

}  // namespace tactus::firmware
