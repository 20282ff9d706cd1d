// The reading of an encoder in a tick, from GPIO edges or from a counter.
#pragma once

#include <cstdint>

#include "drivers/gpio_axis/quadrature.h"
#include "hal/clock.h"

namespace tactus::drivers {

// Counts start at 0 at the restart. They are not reversed yet.
struct EncoderReading {
  std::int64_t count = 0;  // invalid if there is a fault
  double counts_per_s = 0.0;
  hal::TimeNs time_ns = 0;  // when the count was true
  std::int64_t index_count = 0;
  bool index_seen = false;
  EncoderFault fault = EncoderFault::none;  // the first one since the restart
};

}  // namespace tactus::drivers
