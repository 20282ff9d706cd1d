// One line of text in a buffer of fixed size. Text that does not fit is cut, and the line then ends
// in "...". No heap, no locale; one thread.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace tactus::firmware {

// The line. Add texts and numbers, then call end() once.
class TextLine {
 public:
  // The size of the buffer, bytes, with the newline.
  static constexpr std::size_t kRoom = 512;

  // Adds a text, or as much of it as fits.
  TextLine& add(std::string_view text) {
    const std::size_t fits = std::min(text.size(), kTextEnd - size_);
    std::copy_n(text.begin(), fits, room_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += fits;
    is_cut_ = is_cut_ || fits < text.size();
    return *this;
  }

  // Adds the shortest text that reads back to the same number.
  template <class Number>
    requires std::integral<Number> || std::floating_point<Number>
  TextLine& add(Number number) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return add(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
  }

  // Ends the line with its newline, after replacing control characters by '?' so that a terminal
  // can show it as one line.
  TextLine& end() {
    std::replace_if(room_.begin(), room_.begin() + static_cast<std::ptrdiff_t>(size_), is_control,
                    '?');
    const std::string_view ending = is_cut_ ? kCut : kCut.substr(kCut.size() - 1);
    std::ranges::copy(ending, room_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += ending.size();
    return *this;
  }

  // Returns the line so far.
  [[nodiscard]] std::string_view text() const { return {room_.data(), size_}; }
  // Returns true if nothing was added since clear().
  [[nodiscard]] bool empty() const { return size_ == 0; }
  void clear() {
    size_ = 0;
    is_cut_ = false;
  }

 private:
  static bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }

  static constexpr std::string_view kCut = "...\n";
  static constexpr std::size_t kTextEnd = kRoom - kCut.size();

  std::array<char, kRoom> room_{};
  std::size_t size_ = 0;
  bool is_cut_ = false;
};

}  // namespace tactus::firmware
