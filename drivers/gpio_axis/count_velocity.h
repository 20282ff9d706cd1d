// Computes a velocity from the times at which an encoder's edges came.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/clock.h"

namespace tactus::drivers {

// With two or more edges in the window, the velocity is the travel between the oldest and the
// newest of them over the time between them, so neither the tick nor the resolution shows. With
// fewer, it is one count over the time between the last two edges. Without a new edge the shaft has
// moved less than a count since the last one. The estimate is therefore at most one count over that
// time, and decays to zero after kStandstill_ns. An edge that is crossed forth and back is no
// travel.
class CountVelocity {
 public:
  static constexpr hal::TimeNs kStandstill_ns = 200'000'000;

  explicit CountVelocity(hal::TimeNs window_ns) : window_ns_(window_ns) {}

  void restart() { size_ = 0; }

  // Takes an edge, in half counts: 2 k + 1 is the edge between count k and k + 1. Times do not go
  // back.
  void saw(std::int64_t half_counts, hal::TimeNs time_ns);

  // Returns the velocity in counts per second.
  [[nodiscard]] double at(hal::TimeNs now_ns) const;

 private:
  struct Point {
    std::int64_t half_counts = 0;
    hal::TimeNs time_ns = 0;
  };
  static constexpr std::size_t kPoints = 32;

  // Returns a remembered edge; age 0 is the newest.
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
