#include "firmware/bare_metal/line.h"

#include <algorithm>
#include <charconv>

namespace tactus::firmware {

Line& Line::add(std::string_view words) {
  const std::size_t count = std::min(words.size(), room_.size() - size_);
  std::copy_n(words.begin(), count, room_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += count;
  return *this;
}

Line& Line::add(std::uint64_t number) {
  std::array<char, 20> digits{};
  const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
  return add(" ").add(std::string_view(digits.begin(), end));
}

Line& Line::add_hex(std::uint64_t number) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  add(" ");
  for (int shift = 60; shift >= 0; shift -= 4) {
    add(kDigits.substr((number >> static_cast<unsigned>(shift)) & 15U, 1));
  }
  return *this;
}

}  // namespace tactus::firmware
