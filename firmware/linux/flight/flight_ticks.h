// Keeps the last ticks of one device in static memory: the inputs and results of every tick.
//
// The loop adds each tick and never waits. One other thread copies ticks while the loop goes on;
// reading a tick that has been overwritten fails. There is no heap and no lock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "firmware/limits.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// The ticks of one device. The object belongs into static storage.
class FlightTicks {
 public:
  // Adds the last tick. Returns true if a new history begins with it: after forget(), and if a
  // tick is missing before it. Call from the loop's thread between ticks.
  bool add(const RecordedTick& tick);
  // Drops all ticks at the next add(). Call from the loop's thread.
  void forget() { begins_ = true; }

  // Returns the first tick of the history, and one beyond its last one. Any thread.
  [[nodiscard]] std::uint64_t begin_tick() const {
    return begin_tick_.load(std::memory_order_acquire);
  }
  [[nodiscard]] std::uint64_t end_tick() const { return end_tick_.load(std::memory_order_acquire); }

  // Copies a tick. Returns false if it has been overwritten or was never there. For one thread
  // beside the loop.
  bool read(std::uint64_t number, RecordedTick& to) const;

 private:
  // A tick as atomic 64-bit words, which the loop may write while the other thread reads.
  using Slot =
      std::array<std::atomic<std::uint64_t>,
                 (sizeof(RecordedTick) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t)>;
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

  // Writes a tick into its slot, or reads one.
  static void put(Slot& slot, const RecordedTick& tick);
  static void take(const Slot& slot, RecordedTick& to);

  // Loop only: true if the next tick begins a new history.
  bool begins_ = true;
  std::atomic<std::uint64_t> begin_tick_{0};
  std::atomic<std::uint64_t> end_tick_{0};
  std::array<Slot, kFlightTicks> ticks_{};
};

}  // namespace tactus::firmware
