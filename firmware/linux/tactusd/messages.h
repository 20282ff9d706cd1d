// Helpers for the messages that tactusd prints to stderr with printf. Any thread.
#pragma once

#include <cstddef>
#include <string_view>

namespace tactus::firmware {

// The size of a message's buffer, bytes.
inline constexpr std::size_t kMaxMessage = 512;

// Returns the length of a view as printf's "%.*s" takes it.
inline int length(std::string_view text) {
  return static_cast<int>(text.size());
}

}  // namespace tactus::firmware
