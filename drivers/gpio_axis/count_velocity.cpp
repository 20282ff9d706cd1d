#include "drivers/gpio_axis/count_velocity.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

void CountVelocity::saw(std::int64_t half_counts, hal::TimeNs time_ns) {
  newest_ = (newest_ + 1) % kPoints;
  points_[newest_] = {.half_counts = half_counts, .time_ns = time_ns};
  size_ = std::min(size_ + 1, kPoints);
}

double CountVelocity::between_edges() const {
  std::size_t reference = 1;
  while (reference + 1 < size_ && point(0).time_ns - point(reference + 1).time_ns <= window_ns_) {
    ++reference;
  }
  const hal::TimeNs time_ns = point(0).time_ns - point(reference).time_ns;
  if (time_ns <= 0) {
    return 0.0;
  }
  const auto half_counts = static_cast<double>(point(0).half_counts - point(reference).half_counts);
  return 0.5e9 * half_counts / static_cast<double>(time_ns);
}

double CountVelocity::at(hal::TimeNs now_ns) const {
  if (size_ < 2) {
    return 0.0;
  }
  const hal::TimeNs silence_ns = now_ns - point(0).time_ns;
  if (silence_ns >= kStandstill_ns) {
    return 0.0;
  }
  const double velocity = between_edges();
  if (silence_ns <= 0) {
    return velocity;
  }
  const double most = 1e9 / static_cast<double>(silence_ns);
  return std::copysign(std::min(std::abs(velocity), most), velocity);
}

}  // namespace tactus::drivers
