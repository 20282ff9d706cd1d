// What tactusd tells on stderr, by printf: texts are views there, and messages have a fixed room.
#pragma once

#include <cstddef>
#include <string_view>

namespace tactus::firmware {

inline constexpr std::size_t kMaxMessage = 512;  // of one message

// For "%.*s".
inline int length(std::string_view text) {
  return static_cast<int>(text.size());
}

}  // namespace tactus::firmware
