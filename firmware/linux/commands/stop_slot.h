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
    // The signed difference is right also after the 32-bit numbers have wrapped.
    const auto ahead = static_cast<std::int32_t>(answered_.load(std::memory_order_acquire) - stop);
    if (ahead < 0) {
      return std::nullopt;
    }
    return StopTaken{.tick = tick_.load(std::memory_order_relaxed),
                     .after = mode_.load(std::memory_order_relaxed)};
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
    tick_.store(done.tick, std::memory_order_relaxed);
    mode_.store(done.after, std::memory_order_relaxed);
    answered_.store(seen_, std::memory_order_release);
    return true;
  }

 private:
  static_assert(std::atomic<Mode>::is_always_lock_free);

  std::atomic<std::uint32_t> posted_{0};
  // Loop only: the number of the newest stop that a tick has had.
  std::uint32_t seen_ = 0;
  // The number of the newest stop carried out, its tick, and the mode after it.
  std::atomic<std::uint32_t> answered_{0};
  std::atomic<std::uint64_t> tick_{0};
  std::atomic<Mode> mode_{Mode::init};
};

}  // namespace tactus::firmware
