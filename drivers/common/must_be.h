// The rule that a text must be one of some words, composed at compile time.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tactus::drivers {

// The text: must be "a", "b" or "c".
class MustBe {
 public:
  template <std::size_t kCount>
  explicit constexpr MustBe(const std::array<std::string_view, kCount>& words) {
    add("must be ");
    for (std::size_t i = 0; i < kCount; ++i) {
      if (i != 0) {
        add(i + 1 == kCount ? " or " : ", ");
      }
      add("\"");
      add(words[i]);
      add("\"");
    }
  }
  [[nodiscard]] constexpr std::string_view view() const { return {text_.data(), size_}; }

 private:
  constexpr void add(std::string_view text) {
    for (const char c : text) {
      text_[size_] = c;  // a text that is too long does not compile
      ++size_;
    }
  }

  std::array<char, 256> text_{};
  std::size_t size_ = 0;
};

}  // namespace tactus::drivers
