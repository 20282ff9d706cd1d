#include "hal/clock.h"

#include <algorithm>

namespace tactus::hal {

TimeNs next_instant_ns(const Phase& phase, TimeNs after_ns) {
  if (after_ns < phase.offset_ns) {
    return phase.offset_ns;
  }
  const TimeNs passed = (after_ns - phase.offset_ns) / phase.period_ns;
  return phase.offset_ns + (passed + 1) * phase.period_ns;
}

Wake Clock::sleep_until(TimeNs wake_ns) {
  DoSleepUntil(wake_ns);
  return Wake{.scheduled_ns = wake_ns, .woke_ns = DoNowNs(), .skipped = 0};
}

Wake Clock::sleep_to_phase(const Phase& phase, const Wake& last) {
  // A loop that overran wakes at an instant after now, not at the one that it missed: it skips
  // ticks and keeps its phase.
  const TimeNs first_ns = next_instant_ns(phase, last.scheduled_ns);
  const TimeNs target_ns = std::max(first_ns, next_instant_ns(phase, DoNowNs()));
  Wake wake = sleep_until(target_ns);
  wake.skipped = (target_ns - first_ns) / phase.period_ns;
  return wake;
}

}  // namespace tactus::hal
