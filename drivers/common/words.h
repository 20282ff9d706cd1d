// A message that is composed without the heap, from texts and numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::drivers {

// Keeps as many characters as fit and drops the rest.
class Words {
 public:
  Words& add(std::string_view text) {
    const std::size_t count = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), count, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  // Adds a number, rounded to at most so many decimals and without trailing zeros.
  Words& add(double number, int decimals = 3);
  Words& add(std::uint32_t number, std::uint32_t base = 10);

  [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }
  void clear() { size_ = 0; }

 private:
  std::array<char, 640> text_{};
  std::size_t size_ = 0;
};

}  // namespace tactus::drivers
