// Hands stops from any thread to the loop, and the tick that carried them out back. A stop bypasses
// the command queue. Lock-free; all functions are real time.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "firmware/control/mode.h"

namespace tactus::firmware {

// The tick that carried out a stop, and the mode after it.
struct StopTaken {
  std::uint64_t tick = 0;
  Mode after = Mode::init;
};

// The slot of one loop. Stops are numbered; a tick carries out all that it has seen.
class StopSlot {
 public:
  // Posts a stop and returns its number. Any thread.
  std::uint32_t post() { return posted_.fetch_add(1, std::memory_order_acq_rel) + 1; }

  // Returns the tick that carried out the stop with that number, or nothing while none has. Any
  // thread.
  [[nodiscard]] std::optional<StopTaken> taken(std::uint32_t stop) const {
    for (;;) {
      const std::uint32_t answered = answered_.load(std::memory_order_acquire);
      // The signed difference is right also after the 32-bit numbers have wrapped.
      if (static_cast<std::int32_t>(answered - stop) < 0) {
        return std::nullopt;
      }
      const std::uint64_t high = tick_high_.load(std::memory_order_acquire);
      const StopTaken taken{.tick = high << 32U | tick_low_.load(std::memory_order_acquire),
                            .after = static_cast<Mode>(mode_.load(std::memory_order_acquire))};
      // The parts belong together unless the loop has begun to write those of a later stop.
      if (begun_.load(std::memory_order_relaxed) == answered) {
        return taken;
      }
    }
  }

  // Returns true if a stop was posted since the last call. Call from the loop before a tick.
  bool take() {
    const std::uint32_t posted = posted_.load(std::memory_order_acquire);
    const bool is_new = posted != seen_;
    seen_ = posted;
    return is_new;
  }

  // Answers the stops that the tick has carried out. Returns true if there were any. Call from the
  // loop after the tick.
  bool answer(const StopTaken& done) {
    if (seen_ == answered_.load(std::memory_order_relaxed)) {
      return false;
    }
    begun_.store(seen_, std::memory_order_relaxed);
    tick_low_.store(static_cast<std::uint32_t>(done.tick), std::memory_order_release);
    tick_high_.store(static_cast<std::uint32_t>(done.tick >> 32U), std::memory_order_release);
    mode_.store(static_cast<std::uint32_t>(done.after), std::memory_order_release);
    answered_.store(seen_, std::memory_order_release);
    return true;
  }

 private:
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

  std::atomic<std::uint32_t> posted_{0};
  // Loop only: the number of the newest stop that a tick has had.
  std::uint32_t seen_ = 0;
  // The number of the newest stop carried out, its tick in two halves since the smallest processor
  // has no word of 64 bits, and the mode after it. `begun_` is that number while they are written.
  std::atomic<std::uint32_t> answered_{0};
  std::atomic<std::uint32_t> begun_{0};
  std::atomic<std::uint32_t> tick_low_{0};
  std::atomic<std::uint32_t> tick_high_{0};
  // A word: RISC-V has no atomic bytes.
  std::atomic<std::uint32_t> mode_{static_cast<std::uint32_t>(Mode::init)};
};

}  // namespace tactus::firmware
