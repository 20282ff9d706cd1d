// A quadrature counter in hardware: it counts every step of an encoder without an interrupt, and
// can latch the count at the encoder's index pulse.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// The direction of the last step; `unknown` if the hardware does not report it.
enum class CountDirection : std::uint8_t { unknown, forward, backward };

// The settings of Counter::start.
struct CounterConfig {
  // The highest count; the counter wraps between it and 0. 0: the hardware's own ceiling.
  std::uint64_t ceiling = 0;
  // True: the count at every index pulse is kept for read_index.
  bool watch_index = false;
};

// The count at one moment.
struct CounterReading {
  std::uint64_t count = 0;  // from 0 to the ceiling
  // A time just before the count was read, on the clock of Clock::now_ns.
  TimeNs time_ns = 0;
  CountDirection direction = CountDirection::unknown;
  // True if the hardware saw states that cannot follow each other, or excessive noise: steps may be
  // lost.
  bool noisy = false;
};

// The count that the hardware or the kernel took at an index pulse.
struct CounterIndexEvent {
  std::uint64_t count = 0;  // the count at the pulse
  TimeNs time_ns = 0;       // the time of the pulse, on the clock of Clock::now_ns
};

// Returns the signed distance, in counts, from `from` to `to` on a counter that wraps after
// `ceiling`, in the shorter direction. Both are from 0 to `ceiling`.
std::int64_t count_difference(std::uint64_t from, std::uint64_t to, std::uint64_t ceiling);

// A counter with one encoder. It counts x4: every edge of both channels. A power cycle or another
// program may change the count, so only differences are meaningful.
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

  // Returns the count now. A count above the ceiling is the error io.
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
