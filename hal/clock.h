// Monotonic time, deadlines, and sleep until the next instant of a fixed phase.
#pragma once

#include <cstdint>
#include <limits>

namespace tactus::hal {

// Nanoseconds of the board's monotonic clock (CLOCK_MONOTONIC on Linux), which never goes back. The
// range is 292 years.
using TimeNs = std::int64_t;

// Deadlines are absolute times. With a deadline in the past a call does what it can at once and
// does not wait.
inline constexpr TimeNs kNoWait = 0;
inline constexpr TimeNs kForever = std::numeric_limits<TimeNs>::max();

// The instants offset_ns + k * period_ns, k = 0, 1, 2...; period_ns > 0. Two loops with the same
// period and different offsets do not run at the same time.
struct Phase {
  TimeNs period_ns = 1'000'000;
  TimeNs offset_ns = 0;
};

// Returns the first instant of the phase that is later than `after_ns`.
TimeNs next_instant_ns(const Phase& phase, TimeNs after_ns);

struct Wake {
  TimeNs scheduled_ns = 0;   // the requested instant
  TimeNs woke_ns = 0;        // the time of waking; the difference is the latency
  std::int64_t skipped = 0;  // instants of the phase skipped since the last wake
};

// Real time: all functions, after opening. Thread: any thread may call now_ns; one thread at a time
// may sleep; neither from an interrupt. No function can fail: an implementation that is interrupted
// continues to sleep.
class Clock {
 public:
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  TimeNs now_ns() const { return DoNowNs(); }

  // Sleeps until `wake_ns`. Returns at once if that has passed.
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
