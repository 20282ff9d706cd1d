// The board's monotonic clock on Linux.
#pragma once

#include "hal/clock.h"

namespace tactus::hal {

// CLOCK_MONOTONIC, with sleeps by clock_nanosleep to an absolute time. Any thread; real time.
class LinuxClock final : public Clock {
 private:
  TimeNs DoNowNs() const override;
  void DoSleepUntil(TimeNs wake_ns) override;
};

}  // namespace tactus::hal
