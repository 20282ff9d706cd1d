#include "drivers/common/counted_shaft.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// Returns to - from. Unsigned subtraction wraps as the counter does.
std::int32_t counts_between(std::int32_t from, std::int32_t to) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(to) -
                                   static_cast<std::uint32_t>(from));
}

}  // namespace

void CountedShaft::forget() {
  counts_ = 0;
  velocity_rad_per_s_ = 0.0;
  is_known_ = false;
  is_near_ = false;
}

bool CountedShaft::take(std::int32_t count, hal::TimeNs time_ns) {
  if (!is_known_) {
    counts_ = count;
    last_count_ = count;
  }
  const bool is_later = !is_known_ || time_ns > last_ns_;
  if (is_near_) {
    const double passed_s = is_later ? 1e-9 * static_cast<double>(time_ns - last_ns_) : 0.0;
    const std::int32_t from = is_later ? last_count_ : anchor_count_;
    const double step_rad = counts_between(from, count) * config_.rad_per_count;
    if (std::abs(step_rad) > config_.max_speed_rad_per_s * passed_s + config_.jump_margin_rad) {
      return false;
    }
    smooth(step_rad, passed_s);
  } else {
    velocity_rad_per_s_ = 0.0;
  }
  counts_ += counts_between(last_count_, count);
  last_count_ = count;
  if (is_later) {
    anchor_count_ = count;
    last_ns_ = time_ns;
  } else if (!is_near_) {
    anchor_count_ = count;
  }
  is_known_ = true;
  is_near_ = true;
  return true;
}

void CountedShaft::smooth(double step_rad, double passed_s) {
  if (passed_s <= 0.0) {
    return;
  }
  const double speed = config_.max_speed_rad_per_s;
  const double velocity_rad_per_s = std::clamp(step_rad / passed_s, -speed, speed);
  const double share = passed_s / (passed_s + config_.velocity_filter_s);
  velocity_rad_per_s_ += share * (velocity_rad_per_s - velocity_rad_per_s_);
}

}  // namespace tactus::drivers
