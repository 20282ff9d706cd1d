#include "firmware/linux/tactusd/loop.h"

#include <algorithm>
#include <cmath>

namespace tactus::firmware {

bool LoopCourse::goes_on(bool is_active, bool stopping) {
  --left_;
  // A loop that is to stop ends only after the tick in which the last device has left `active`.
  const bool stopped = stopping && !is_active;
  return left_ > 0 && !stopped;
}

bool has_device_in(const Controller& controller, Mode mode) {
  bool is_in = false;
  for (std::size_t i = 0; i < controller.device_count(); ++i) {
    is_in = is_in || controller.mode(i) == mode;
  }
  return is_in;
}

LoopReport loop_report(const LoopTick& tick, bool watchdog_driven, bool has_crashed) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  return {.status = (tick.late ? kLoopLate : kLoopOnTime) |
                    (watchdog_driven ? kLoopOnTime : kLoopWatchdogLost) |
                    (has_crashed ? kLoopHelperCrashed : kLoopOnTime),
          .missed_ticks = static_cast<std::uint32_t>(std::min(tick.skipped, kMost))};
}

hal::Phase loop_phase(double rate_hz) {
  return {.period_ns = static_cast<hal::TimeNs>(std::llround(1e9 / rate_hz)), .offset_ns = 0};
}

}  // namespace tactus::firmware
