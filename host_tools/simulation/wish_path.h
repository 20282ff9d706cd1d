// The path that the hand wants to follow: waypoints with times, joined smoothly.
#pragma once

#include <cstddef>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// The place that the hand wants to reach, and the time at which it wants to be there.
struct Waypoint {
  // Time from the start of the run.
  double t_s = 0.0;
  // Position, m, world frame.
  Vec3 p_W = Vec3::Zero();
};

// A smooth curve through waypoints.
//
// Between two waypoints each axis follows the quintic polynomial that has the waypoints' velocities
// and no acceleration at either end. A waypoint at which the motion turns or rests gets velocity
// zero; between two of these the motion is the minimum-jerk reach of Flash and Hogan (1985). A
// densely sampled path is followed without stopping, and the curve never overshoots a waypoint that
// is an extreme of its axis. Before the first time and after the last one the hand holds still,
// unless the path repeats.
class WishPath {
 public:
  // Throws InputError if there is no waypoint, times do not rise, or a number is not finite.
  explicit WishPath(std::vector<Waypoint> waypoints);

  // Returns the path that goes forth, back again, and so on without end.
  [[nodiscard]] WishPath there_and_back() const;
  // Returns the path that begins anew at its end, without end; it should end where it begins.
  [[nodiscard]] WishPath repeated() const;

  // Returns the wished position at a time, m, world frame. The call is cheap if times rise from
  // call to call, and correct in any order.
  [[nodiscard]] Vec3 at(double time_s);

  // Returns the centre of the box around all waypoints, m, world frame.
  [[nodiscard]] Vec3 middle() const;
  // Returns half the edges of that box, m.
  [[nodiscard]] Vec3 reach() const;
  // Returns the time of the last waypoint.
  [[nodiscard]] double end_s() const { return waypoints_.back().t_s; }

 private:
  [[nodiscard]] Vec3 lowest() const;
  [[nodiscard]] Vec3 highest() const;

  std::vector<Waypoint> waypoints_;
  // The velocity at each waypoint, m/s.
  std::vector<Vec3> velocities_;
  // The segment of the last call of at().
  std::size_t segment_ = 0;
  bool repeats_ = false;
};

}  // namespace tactus::host
