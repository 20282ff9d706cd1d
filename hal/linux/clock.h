// The board's monotonic clock.
#pragma once

#include "hal/clock.h"

namespace tactus::hal {

// Uses CLOCK_MONOTONIC and sleeps by clock_nanosleep to an absolute time. Any thread.
class LinuxClock final : public Clock {
 private:
  TimeNs DoNowNs() const override;
  void DoSleepUntil(TimeNs wake_ns) override;
};

}  // namespace tactus::hal
