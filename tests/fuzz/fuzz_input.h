// The fuzzer's bytes, read as numbers, times and CAN frames; and the assert of the properties.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>

#include "hal/can_frame.h"

namespace tactus::fuzz {

// Ends the program, which libFuzzer reports with the input, unless the property holds.
inline void require(bool holds, const char* property) {
  if (!holds) {
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
  }
}

class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  [[nodiscard]] bool empty() const { return rest_.empty(); }

  // The next bytes as a number or another plain type; zeros where the input ends.
  template <class T>
  T take() {
    T value{};
    const std::size_t count = std::min(sizeof value, rest_.size());
    if (count > 0) {
      std::memcpy(&value, rest_.data(), count);
    }
    rest_ = rest_.subspan(count);
    return value;
  }

  // Returns a number from 0 to count - 1.
  std::uint32_t below(std::uint32_t count) { return take<std::uint16_t>() % count; }

  // Copies as many bytes as are left; the others stay as they are.
  void fill(std::span<std::byte> bytes) {
    const std::size_t count = std::min(bytes.size(), rest_.size());
    if (count > 0) {
      std::memcpy(bytes.data(), rest_.data(), count);
    }
    rest_ = rest_.subspan(count);
  }

  // A well-formed frame with that identifier: flags, length, bytes.
  hal::CanFrame frame(std::uint32_t id) {
    const auto flags = take<std::uint8_t>();
    hal::CanFrame frame{.id = id, .extended = id > hal::kMaxStandardId || (flags & 1U) != 0};
    frame.fd = (flags & 2U) != 0;
    frame.remote = !frame.fd && (flags & 4U) != 0;
    frame.bit_rate_switch = frame.fd && (flags & 8U) != 0;
    frame.length = frame.fd ? hal::padded_fd_length(below(hal::kMaxCanFdBytes + 1))
                            : static_cast<std::uint8_t>(below(hal::kMaxCanBytes + 1));
    fill(std::span(frame.data).first(frame.length));
    return frame;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace tactus::fuzz
