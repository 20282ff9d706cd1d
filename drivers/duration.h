// Durations as a configuration has them, on the clock of the drivers.
#pragma once

#include "hal/clock.h"

namespace tactus::drivers {

constexpr hal::TimeNs ns_of(double duration_s) {
  return static_cast<hal::TimeNs>(1e9 * duration_s);
}

}  // namespace tactus::drivers
