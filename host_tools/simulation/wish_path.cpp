#include "host_tools/simulation/wish_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

void check(const std::vector<Waypoint>& waypoints) {
  if (waypoints.empty()) {
    throw InputError("a wish path needs at least one waypoint");
  }
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (!std::isfinite(waypoints[i].t_s) || !waypoints[i].p_W.allFinite()) {
      throw InputError(fmt::format("waypoint {} is not a finite number", i + 1));
    }
    if (i > 0 && waypoints[i].t_s <= waypoints[i - 1].t_s) {
      throw InputError(fmt::format("waypoint {} is at {} s, not after the one before it, at {} s",
                                   i + 1, waypoints[i].t_s, waypoints[i - 1].t_s));
    }
  }
}

// Returns the velocity at an inner waypoint from the slopes on both sides: zero if the motion
// turns, else their harmonic mean (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980), which does
// not overshoot.
double via_velocity(double slope_before, double slope_after) {
  if (slope_before * slope_after <= 0.0) {
    return 0.0;
  }
  return 2.0 * slope_before * slope_after / (slope_before + slope_after);
}

Vec3 slope(const Waypoint& from, const Waypoint& to) {
  return (to.p_W - from.p_W) / (to.t_s - from.t_s);
}

}  // namespace

WishPath::WishPath(std::vector<Waypoint> waypoints) : waypoints_(std::move(waypoints)) {
  check(waypoints_);
  velocities_.assign(waypoints_.size(), Vec3::Zero());
  for (std::size_t i = 1; i + 1 < waypoints_.size(); ++i) {
    const Vec3 before = slope(waypoints_[i - 1], waypoints_[i]);
    const Vec3 after = slope(waypoints_[i], waypoints_[i + 1]);
    for (int axis = 0; axis < 3; ++axis) {
      velocities_[i][axis] = via_velocity(before[axis], after[axis]);
    }
  }
}

WishPath WishPath::there_and_back() const {
  std::vector<Waypoint> waypoints = waypoints_;
  for (auto place = waypoints_.rbegin() + 1; place != waypoints_.rend(); ++place) {
    waypoints.push_back({.t_s = 2.0 * end_s() - place->t_s, .p_W = place->p_W});
  }
  WishPath path(std::move(waypoints));
  path.repeats_ = waypoints_.size() > 1;
  return path;
}

WishPath WishPath::repeated() const {
  WishPath path = *this;
  path.repeats_ = waypoints_.size() > 1;
  return path;
}

Vec3 WishPath::at(double time_s) {
  const double t_s = repeats_ && time_s > end_s() ? std::fmod(time_s, end_s()) : time_s;
  if (t_s <= waypoints_.front().t_s) {
    return waypoints_.front().p_W;
  }
  if (t_s >= waypoints_.back().t_s) {
    return waypoints_.back().p_W;
  }
  if (t_s < waypoints_[segment_].t_s) {
    segment_ = 0;
  }
  while (t_s >= waypoints_[segment_ + 1].t_s) {
    ++segment_;
  }
  const Waypoint& from = waypoints_[segment_];
  const Waypoint& to = waypoints_[segment_ + 1];
  const double duration = to.t_s - from.t_s;
  const double s = (t_s - from.t_s) / duration;
  const double rest = 1.0 - s;
  // Quintic Hermite basis with zero accelerations at both ends; `blend` is Flash and Hogan's 10 s^3
  // - 15 s^4 + 6 s^5, the other two carry the velocities at either end.
  const double blend = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
  const double leaving = s * rest * rest * rest * (1.0 + 3.0 * s);
  const double arriving = -s * s * s * rest * (4.0 - 3.0 * s);
  return from.p_W + blend * (to.p_W - from.p_W) +
         duration * (leaving * velocities_[segment_] + arriving * velocities_[segment_ + 1]);
}

Vec3 WishPath::lowest() const {
  Vec3 lowest_W = waypoints_.front().p_W;
  for (const Waypoint& waypoint : waypoints_) {
    lowest_W = lowest_W.cwiseMin(waypoint.p_W);
  }
  return lowest_W;
}

Vec3 WishPath::highest() const {
  Vec3 highest_W = waypoints_.front().p_W;
  for (const Waypoint& waypoint : waypoints_) {
    highest_W = highest_W.cwiseMax(waypoint.p_W);
  }
  return highest_W;
}

Vec3 WishPath::middle() const {
  return 0.5 * (lowest() + highest());
}

Vec3 WishPath::reach() const {
  return 0.5 * (highest() - lowest());
}

}  // namespace tactus::host
