// Velocity from the times at which an encoder's edges came.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/clock.h"

namespace tactus::drivers {

// Above one edge in the window: the way between the oldest edge in the window and the newest over
// the time between them, so that neither the tick nor the resolution shows. Below: one count over
// the time between the last two edges. When no edge comes, the next one is at least a count away:
// the estimate cannot exceed one count over the time since the last, and decays with it, to zero
// after kStandstill_ns. An edge crossed forth and back is no way at all.
class CountVelocity {
 public:
  static constexpr hal::TimeNs kStandstill_ns = 200'000'000;

  explicit CountVelocity(hal::TimeNs window_ns) : window_ns_(window_ns) {}

  void restart() { size_ = 0; }

  // The place of an edge in half counts: 2 k + 1 between count k and k + 1. Times do not go back.
  void saw(std::int64_t half_counts, hal::TimeNs time_ns);

  // Counts per second.
  [[nodiscard]] double at(hal::TimeNs now_ns) const;

 private:
  struct Point {
    std::int64_t half_counts = 0;
    hal::TimeNs time_ns = 0;
  };
  static constexpr std::size_t kPoints = 32;

  // 0 is the newest.
  [[nodiscard]] const Point& point(std::size_t age) const {
    return points_[(newest_ + kPoints - age) % kPoints];
  }
  [[nodiscard]] double between_edges() const;

  hal::TimeNs window_ns_;
  std::array<Point, kPoints> points_{};
  std::size_t newest_ = 0;
  std::size_t size_ = 0;
};

}  // namespace tactus::drivers
