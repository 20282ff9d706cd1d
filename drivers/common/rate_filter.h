// Computes a velocity from positions, for devices that measure none: the smoothed difference.
#pragma once

#include <numbers>

#include "hal/clock.h"

namespace tactus::drivers {

// A first-order low-pass filter over the difference quotient. The samples may have any spacing in
// time.
class RateFilter {
 public:
  explicit RateFilter(double cutoff_Hz) : pole_per_s_(2.0 * std::numbers::pi * cutoff_Hz) {}

  // Forgets the past: the rate at the next position is zero.
  void restart() { fresh_ = true; }

  // Takes the next position and returns the rate, in the position's unit per second. A time that is
  // not later than the last one changes nothing.
  double update(double position, hal::TimeNs time_ns) {
    if (fresh_) {
      rate_ = 0.0;
    } else if (time_ns > last_ns_) {
      const double elapsed_s = static_cast<double>(time_ns - last_ns_) * 1e-9;
      const double turned = pole_per_s_ * elapsed_s;
      rate_ += turned / (1.0 + turned) * ((position - last_) / elapsed_s - rate_);
    } else {
      return rate_;
    }
    fresh_ = false;
    last_ = position;
    last_ns_ = time_ns;
    return rate_;
  }

 private:
  double pole_per_s_;
  double last_ = 0.0;
  double rate_ = 0.0;
  hal::TimeNs last_ns_ = 0;
  bool fresh_ = true;
};

}  // namespace tactus::drivers
