#include "drivers/counted_shaft.h"

#include <cmath>

namespace tactus::drivers {

void CountedShaft::forget() {
  counts_ = 0;
  velocity_rad_per_s_ = 0.0;
  is_known_ = false;
  is_near_ = false;
}

bool CountedShaft::take(std::int32_t count, hal::TimeNs time_ns) {
  if (!is_known_) {
    counts_ = count;
    is_known_ = true;
    is_near_ = true;
    last_count_ = count;
    last_ns_ = time_ns;
    return true;
  }
  // Unsigned subtraction wraps as the counter does.
  const auto step = static_cast<std::int32_t>(static_cast<std::uint32_t>(count) -
                                              static_cast<std::uint32_t>(last_count_));
  const double step_rad = step * config_.rad_per_count;
  const double passed_s = time_ns > last_ns_ ? 1e-9 * static_cast<double>(time_ns - last_ns_) : 0.0;
  if (is_near_) {
    if (!can_be_true(step_rad, passed_s)) {
      return false;
    }
    smooth(step_rad, passed_s);
  } else {
    velocity_rad_per_s_ = 0.0;
  }
  is_near_ = true;
  counts_ += step;
  last_count_ = count;
  last_ns_ = time_ns > last_ns_ ? time_ns : last_ns_;
  return true;
}

bool CountedShaft::can_be_true(double step_rad, double passed_s) const {
  return std::abs(step_rad) <= config_.max_speed_rad_per_s * passed_s + config_.jump_margin_rad;
}

void CountedShaft::smooth(double step_rad, double passed_s) {
  if (passed_s <= 0.0) {
    return;
  }
  const double share = passed_s / (passed_s + config_.velocity_filter_s);
  velocity_rad_per_s_ += share * (step_rad / passed_s - velocity_rad_per_s_);
}

}  // namespace tactus::drivers
