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
  // The highest count; the counter wraps between it and 0. 0: the hardware's own ceiling.
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
  std::uint64_t count = 0;  // the count at the pulse
  TimeNs time_ns = 0;       // the time of the pulse, on the clock of Clock::now_ns
};

// Returns the signed distance from `from` to `to` on a counter that wraps after `ceiling`, in the
// shorter direction.
std::int64_t count_difference(std::uint64_t from, std::uint64_t to, std::uint64_t ceiling);

// It counts x4: every edge of both channels. A power cycle or another program may change the count,
// so only differences are meaningful.
//
// Real time: read and read_index, after start; they allocate nothing. Thread: one at a time for
// each object; not from an interrupt. Every call can return, besides the errors that it lists:
//   disconnected   the counter is gone
//   io             anything else the system reports
class Counter {
 public:
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  // Configures the counter and starts counting. It may be called again. Not real time.
  //   not_supported     it cannot count x4, not up to this ceiling, does not say what its ceiling
  //                     is, or has no index events
  //   not_permitted, busy
  Result<void> start(const CounterConfig& config);

  // Returns the ceiling in effect; 0 before `start`.
  std::uint64_t ceiling() const { return ceiling_; }

  // Returns the count now.
  //   invalid_state  not started
  Result<CounterReading> read();

  // Waits until there is an index pulse or the deadline has passed. Then returns the number of
  // events put into `events`, at least 1, oldest first. The system keeps a limited number of pulses
  // (Linux: 64); further ones are lost without a report.
  //   timeout           no pulse
  //   invalid_argument  `events` is empty
  //   invalid_state     not started with watch_index
  Result<std::size_t> read_index(std::span<CounterIndexEvent> events, TimeNs deadline_ns);

 protected:
  Counter() = default;
  ~Counter() = default;

 private:
  // The public functions have checked the arguments. DoStart returns the ceiling in effect, above
  // 0.
  virtual Result<std::uint64_t> DoStart(const CounterConfig& config) = 0;
  virtual Result<CounterReading> DoRead() = 0;
  virtual Result<std::size_t> DoReadIndex(std::span<CounterIndexEvent> events,
                                          TimeNs deadline_ns) = 0;

  std::uint64_t ceiling_ = 0;
  bool watches_index_ = false;
};

}  // namespace tactus::hal
