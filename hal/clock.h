// Monotonic time, deadlines, and sleeping to a fixed phase.
#pragma once

#include <cstdint>
#include <limits>

namespace tactus::hal {

// Nanoseconds of the board's monotonic clock (CLOCK_MONOTONIC on Linux); never goes back. 292 years
// fit.
using TimeNs = std::int64_t;

// Deadlines are absolute. One that has passed means: do what can be done at once, wait for nothing.
inline constexpr TimeNs kNoWait = 0;
inline constexpr TimeNs kForever = std::numeric_limits<TimeNs>::max();

// The instants offset_ns + k * period_ns, k = 0, 1, 2...; period_ns > 0. Two loops of one period
// and different offsets keep out of each other's way.
struct Phase {
  TimeNs period_ns = 1'000'000;
  TimeNs offset_ns = 0;
};

// The first instant of the phase that is later than `after_ns`.
TimeNs next_instant_ns(const Phase& phase, TimeNs after_ns);

struct Wake {
  TimeNs scheduled_ns = 0;   // the instant asked for
  TimeNs woke_ns = 0;        // when it really was; the difference is the latency
  std::int64_t skipped = 0;  // instants of the phase that passed unused since the last wake
};

// Real time: yes, after opening. Thread: now_ns from any thread, sleeping from any one thread at a
// time; neither from an interrupt. Nothing here can fail: an implementation that is interrupted
// goes back to sleep.
class Clock {
 public:
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  TimeNs now_ns() const { return DoNowNs(); }

  // Returns at once if `wake_ns` has passed.
  Wake sleep_until(TimeNs wake_ns);

  // Sleeps to the first instant of `phase` that is later than both now and the last wake's
  // `scheduled_ns`. A loop that overran loses instants but not its phase:
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
