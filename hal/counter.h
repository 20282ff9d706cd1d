// A quadrature counter in hardware: counts every step of an encoder without an interrupt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

enum class CountDirection : std::uint8_t { unknown, forward, backward };

struct CounterConfig {
  // The highest count: one more is 0 again, and one less than 0 is this. 0: as the hardware has it.
  std::uint64_t ceiling = 0;
  bool watch_index = false;  // report the count at every index pulse
};

struct CounterReading {
  std::uint64_t count = 0;  // from 0 to the ceiling
  TimeNs time_ns = 0;       // just before the count was read, on the clock of Clock::now_ns
  CountDirection direction = CountDirection::unknown;
  bool noisy = false;  // the hardware saw states that cannot follow each other, or excessive noise
};

struct CounterIndexEvent {
  std::uint64_t count = 0;  // at the pulse
  TimeNs time_ns = 0;
};

// The signed way from `from` to `to` on a counter that wraps after `ceiling`, the shorter way
// round.
std::int64_t count_difference(std::uint64_t from, std::uint64_t to, std::uint64_t ceiling);

// Counts x4: every edge of both channels. A power cycle or another program may change the count,
// only differences mean something.
//
// Real time: read and read_index, after start; nothing is allocated. Thread: one at a time for each
// object; not from an interrupt. Every call can return, besides what it lists:
//   disconnected   the counter is gone
//   io             anything else the system reports
class Counter {
 public:
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  // Sets it up and lets it count; again after it was started too. Not real time.
  //   not_supported     it cannot count x4, not up to this ceiling, does not say what its ceiling
  //                     is, or has no index events
  //   not_permitted, busy
  Result<void> start(const CounterConfig& config);

  // The ceiling in effect; 0 before `start`.
  std::uint64_t ceiling() const { return ceiling_; }

  //   invalid_state  not started
  Result<CounterReading> read();

  // Waits until an index pulse was seen or the deadline has passed, then hands out what there is,
  // oldest first, and returns how many (at least 1). Pulses beyond what the system keeps are lost
  // without a trace (Linux: 64).
  //   timeout           no pulse
  //   invalid_argument  `events` is empty
  //   invalid_state     not started with watch_index
  Result<std::size_t> read_index(std::span<CounterIndexEvent> events, TimeNs deadline_ns);

 protected:
  Counter() = default;
  ~Counter() = default;

 private:
  // The arguments have been checked. Returns the ceiling in effect, above 0.
  virtual Result<std::uint64_t> DoStart(const CounterConfig& config) = 0;
  virtual Result<CounterReading> DoRead() = 0;
  virtual Result<std::size_t> DoReadIndex(std::span<CounterIndexEvent> events,
                                          TimeNs deadline_ns) = 0;

  std::uint64_t ceiling_ = 0;
  bool watches_index_ = false;
};

}  // namespace tactus::hal
