// The path that the hand wants to follow: waypoints with times, joined smoothly.
#pragma once

#include <cstddef>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::host {

struct Waypoint {
  double t_s = 0.0;
  Vec3 p_W = Vec3::Zero();  // m
};

// Between two waypoints each axis follows the quintic with the waypoints' velocities and no
// acceleration at either end. A waypoint where the motion turns or rests has velocity zero there,
// so between two of them the motion is Flash and Hogan's minimum-jerk reach; a densely sampled path
// is followed without stopping, and the curve never overshoots a waypoint that is an extreme of its
// axis. Before the first time and after the last the hand holds still, unless the path
// repeats.
class WishPath {
 public:
  // Throws InputError, text ready for a user, on an empty path, on times that do not
  // rise and on numbers that are not finite.
  explicit WishPath(std::vector<Waypoint> waypoints);

  // The same way and back again, and so on without end.
  [[nodiscard]] WishPath there_and_back() const;

  // Cheap when time_s rises from call to call; correct for any time_s.
  [[nodiscard]] Vec3 at(double time_s);

  // m: the centre of the box around all waypoints.
  [[nodiscard]] Vec3 middle() const;
  // m: half the box's edges.
  [[nodiscard]] Vec3 reach() const;
  [[nodiscard]] double end_s() const { return waypoints_.back().t_s; }

 private:
  [[nodiscard]] Vec3 lowest() const;
  [[nodiscard]] Vec3 highest() const;

  std::vector<Waypoint> waypoints_;
  std::vector<Vec3> velocities_;
  std::size_t segment_ = 0;
  bool repeats_ = false;
};

}  // namespace tactus::host
