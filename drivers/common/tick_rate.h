// Compares the period of a drive with that of the controller's ticks.
#pragma once

#include <string_view>

#include "drivers/common/words.h"

namespace tactus::drivers {

inline constexpr double kPeriodTolerance = 0.01;  // of a period: allowed for rounding

// Returns true if the period is longer than a tick.
inline bool is_slower(double period_s, double rate_hz) {
  return period_s * rate_hz > 1.0 + kPeriodTolerance;
}

// Begins a refusal: `what` 0.001 s, but the controller ticks every 0.0005 s (...); write
inline void say_period(std::string_view what, double period_s, double rate_hz, Words& words) {
  constexpr int kDecimals = 6;
  words.clear();
  words.add(what)
      .add(period_s, kDecimals)
      .add(" s, but the controller ticks every ")
      .add(1.0 / rate_hz, kDecimals)
      .add(" s (rate_hz = ")
      .add(rate_hz)
      .add("); write ");
}

}  // namespace tactus::drivers
