// Writes numbers and texts into a buffer of fixed size. No heap, no locale; one thread.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace tactus::firmware {

// A text that grows in `room`, which must outlive it. What does not fit is left out.
class TextBuffer {
 public:
  explicit TextBuffer(std::span<char> room) : room_(room) {}

  // Adds a text, or nothing if it does not fit.
  TextBuffer& text(std::string_view text) {
    if (text.size() <= room_.size() - size_) {
      std::ranges::copy(text, room_.subspan(size_).begin());
      size_ += text.size();
    }
    return *this;
  }
  // Adds the shortest text that reads back as the same number.
  template <class Number>
  TextBuffer& number(Number value) {
    return take(std::to_chars(end(), limit(), value));
  }
  // Adds a number with at most `digits` digits.
  TextBuffer& rounded(double value, int digits) {
    return take(std::to_chars(end(), limit(), value, std::chars_format::general, digits));
  }
  // Adds a number with sixteen hexadecimal digits.
  TextBuffer& hex(std::uint64_t value) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    for (unsigned shift = 64; shift > 0; shift -= 4) {
      text(kDigits.substr((value >> (shift - 4)) & 0xFU, 1));
    }
    return *this;
  }

  // Returns the text so far.
  [[nodiscard]] std::span<const char> written() const { return room_.first(size_); }
  [[nodiscard]] std::size_t size() const { return size_; }
  // Returns the number of characters that still fit.
  [[nodiscard]] std::size_t room_left() const { return room_.size() - size_; }
  void clear() { size_ = 0; }

 private:
  [[nodiscard]] char* end() { return room_.data() + size_; }
  [[nodiscard]] char* limit() { return room_.data() + room_.size(); }
  TextBuffer& take(const std::to_chars_result& result) {
    if (result.ec == std::errc{}) {
      size_ = static_cast<std::size_t>(result.ptr - room_.data());
    }
    return *this;
  }

  std::span<char> room_;
  std::size_t size_ = 0;
};

}  // namespace tactus::firmware
