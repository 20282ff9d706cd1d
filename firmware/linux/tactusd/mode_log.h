// Hands the changes of mode from the loop to a thread beside it, which may be late: the loop never
// waits. Lock-free.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "firmware/control/mode.h"

namespace tactus::firmware {

// The log of one loop. One thread notes, another reads.
class ModeLog {
 public:
  // The number of changes that may wait to be read. Older ones are lost.
  static constexpr std::uint32_t kModesKept = 32;

  // Notes the mode after a tick. Call from the loop once per tick; real time.
  void note(Mode mode) {
    if (mode == last_) {
      return;
    }
    const std::uint32_t change = changes_.load(std::memory_order_relaxed);
    modes_[change % kModesKept].store(static_cast<std::uint32_t>(mode), std::memory_order_relaxed);
    changes_.store(change + 1, std::memory_order_release);
    last_ = mode;
  }

  // Returns the oldest mode that was entered and has not been read, or nothing.
  std::optional<Mode> next() {
    const std::uint32_t changes = changes_.load(std::memory_order_acquire);
    read_ = std::max(read_, changes - std::min(changes, kModesKept));
    if (read_ == changes) {
      return std::nullopt;
    }
    return static_cast<Mode>(modes_[read_++ % kModesKept].load(std::memory_order_relaxed));
  }

 private:
  // Bytes are not lock-free on every processor.
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

  // The loop writes these: the modes of the last changes with their number.
  std::atomic<std::uint32_t> changes_{0};
  std::array<std::atomic<std::uint32_t>, kModesKept> modes_{};
  Mode last_ = Mode::init;
  // The reader's: the number of changes that it has read or lost.
  std::uint32_t read_ = 0;
};

}  // namespace tactus::firmware
