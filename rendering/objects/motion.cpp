#include "rendering/objects/motion.h"

#include <cmath>
#include <numbers>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Returns sine and cosine of a number of full turns. Whole turns are taken off first, so that a
// long run stays within the range of sine_cosine().
SineCosine of_turns(double turns) {
  return sine_cosine(2.0 * std::numbers::pi * (turns - std::floor(turns)));
}

// Returns the rotation about a unit axis: Rodrigues' formula, R = c I + s [axis]x + (1 - c) axis
// axis^T.
Mat3 turned_about(const Vec3& axis, const SineCosine& angle) {
  const double rest = 1.0 - angle.cosine;
  Mat3 cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return angle.cosine * Mat3::Identity() + angle.sine * cross + rest * axis * axis.transpose();
}

// Returns true if every component is a number within the world.
bool bounded(const Vec3& v) {
  return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
}

bool is_frequency(double hz) {
  return hz >= 0.0 && std::isfinite(hz);
}

}  // namespace

bool valid(const Motion& motion) {
  return motion.velocity_W.allFinite() && bounded(motion.sway_W) && motion.spin_W.allFinite() &&
         bounded(motion.pivot_W) && is_frequency(motion.sway_Hz) &&
         std::abs(motion.wave_m) <= kWorldBound_m && is_frequency(motion.wave_Hz) &&
         motion.wave_per_m.allFinite();
}

// A point p of the object is at pivot + R (p - pivot) + displacement, as the pivot moves along. So
// the origin is at pivot - R pivot + displacement, and its velocity is that of the displacement
// plus spin x (-R pivot).
Placement place_at(const Motion& motion, double t_s) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const SineCosine sway = of_turns(motion.sway_Hz * t_s);
  Placement at;
  const Vec3 displacement = motion.velocity_W * t_s + sway.sine * motion.sway_W;
  const Vec3 velocity = motion.velocity_W + kTurn * motion.sway_Hz * sway.cosine * motion.sway_W;
  const double rate = motion.spin_W.norm();
  if (rate > 0.0) {
    at.X_WO.rotation = turned_about(motion.spin_W / rate, of_turns(rate * t_s / kTurn));
  }
  const Vec3 origin_to_pivot = at.X_WO.rotation * motion.pivot_W;
  at.X_WO.translation = motion.pivot_W - origin_to_pivot + displacement;
  at.twist = {.linear_W = velocity - motion.spin_W.cross(origin_to_pivot),
              .angular_W = motion.spin_W};
  return at;
}

SineCosine wave_angle(const Motion& motion, const Vec3& rest_O) {
  return of_turns(motion.wave_per_m.dot(rest_O));
}

SineCosine wave_angle(const Motion& motion, double t_s) {
  return of_turns(motion.wave_Hz * t_s);
}

}  // namespace tactus::rendering
