#include "hal/linux/clock.h"

#include <cerrno>
#include <ctime>

#include "hal/linux/system.h"

namespace tactus::hal {

TimeNs LinuxClock::DoNowNs() const {
  return monotonic_now_ns();
}

void LinuxClock::DoSleepUntil(TimeNs wake_ns) {
  const timespec wake = to_timespec(wake_ns);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) {
  }
}

}  // namespace tactus::hal
