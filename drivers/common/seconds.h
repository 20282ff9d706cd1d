// Converts durations in seconds, as configurations have them, to the clock's nanoseconds.
#pragma once

#include "hal/clock.h"

namespace tactus::drivers {

constexpr hal::TimeNs ns_of(double seconds) {
  return static_cast<hal::TimeNs>(seconds * 1e9);
}

// Returns true if the duration has passed. A start in the future counts as now.
constexpr bool has_passed(double duration_s, hal::TimeNs since_ns, hal::TimeNs now_ns) {
  return now_ns > since_ns && now_ns - since_ns >= ns_of(duration_s);
}

}  // namespace tactus::drivers
