// The bodies that are awake in a tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_sleep.h"
#include "rendering/limits.h"

namespace tactus::rendering {

class AwakeBodies {
 public:
  // Lists those of the first `bodies` that do not sleep.
  void list(const BodySleep& sleep, std::size_t bodies) {
    count_ = 0;
    for (std::size_t i = 0; i < bodies; ++i) {
      if (!sleep.is_asleep(i)) {
        numbers_[count_++] = static_cast<std::uint8_t>(i);
      }
    }
  }
  // Returns their numbers, in rising order.
  [[nodiscard]] std::span<const std::uint8_t> numbers() const { return {numbers_.data(), count_}; }

 private:
  std::array<std::uint8_t, kMaxBodies> numbers_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::rendering
