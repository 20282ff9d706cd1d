// Monotonic time, deadlines, and sleep until the next instant of a fixed phase: the clock of the
// device loop and of every deadline in hal.
#pragma once

#include <cstdint>
#include <limits>

namespace tactus::hal {

// A time in nanoseconds of the board's monotonic clock (CLOCK_MONOTONIC on Linux), which never goes
// back; also a duration. The range is 292 years.
using TimeNs = std::int64_t;

// Deadlines are absolute times. With a deadline in the past, such as kNoWait, a call does what it
// can at once and does not wait. With kForever it waits until it has something to return.
inline constexpr TimeNs kNoWait = 0;
inline constexpr TimeNs kForever = std::numeric_limits<TimeNs>::max();

// The instants at which a loop runs: offset_ns + k * period_ns for k = 0, 1, 2... Two loops with
// the same period and different offsets do not run at the same time.
struct Phase {
  // Above 0.
  TimeNs period_ns = 1'000'000;
  TimeNs offset_ns = 0;
};

// Returns the first instant of the phase that is later than `after_ns`. That is the offset itself
// for a time before it.
TimeNs next_instant_ns(const Phase& phase, TimeNs after_ns);

struct Wake {
  // The instant that was requested.
  TimeNs scheduled_ns = 0;
  // The time at which the sleeper woke. The difference to scheduled_ns is the latency.
  TimeNs woke_ns = 0;
  // The number of instants of the phase that were left out since the last wake; 0 from sleep_until.
  std::int64_t skipped = 0;
};

// The board's clock. No function can fail: an implementation that is interrupted continues to
// sleep.
//
// Real time: all functions, after opening. Thread: any thread may call now_ns; one thread at a time
// may sleep; neither from an interrupt.
class Clock {
 public:
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  // Returns the time now.
  TimeNs now_ns() const { return DoNowNs(); }

  // Sleeps until `wake_ns`. Returns at once if that has passed. The times of the result are filled.
  Wake sleep_until(TimeNs wake_ns);

  // Sleeps until the first instant of `phase` that is later than both now and the last wake's
  // `scheduled_ns`. A loop that overran skips instants but keeps its phase:
  //   for (Wake wake = clock.sleep_until(start);; wake = clock.sleep_to_phase(phase, wake)) tick();
  Wake sleep_to_phase(const Phase& phase, const Wake& last);

 protected:
  Clock() = default;
  ~Clock() = default;

 private:
  virtual TimeNs DoNowNs() const = 0;
  virtual void DoSleepUntil(TimeNs wake_ns) = 0;
};

}  // namespace tactus::hal
