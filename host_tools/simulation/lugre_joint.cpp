#include "host_tools/simulation/lugre_joint.h"

#include <cmath>

#include "host_tools/simulation/portable_math.h"

namespace tactus::host {
namespace {

// Beyond 6.1 Stribeck velocities the bell exp(-(v/vs)^2) is below a double's rounding of 1.
constexpr double kBellIsOver = 37.0;

}  // namespace

LuGreJoint::LuGreJoint(const LuGreParameters& parameters)
    : parameters_(parameters),
      per_stribeck_velocity_(1.0 / parameters.stribeck_velocity),
      per_stiffness_(parameters.coulomb > 0.0 ? 1.0 / parameters.bristle_stiffness : 0.0) {}

// dz/dt = v - sigma0 |v| z / g(v) has, for constant v, the solution z = s g/sigma0 + (z0 - s
// g/sigma0) exp(-a) with s = sgn(v), g(v) the
// friction of steady sliding and a = sigma0 |v| dt / g.
double LuGreJoint::advance(double velocity, double dt_s) {
  if (parameters_.coulomb <= 0.0) {
    return parameters_.viscous * velocity;
  }
  const double ratio = velocity * per_stribeck_velocity_;
  const double square = ratio * ratio;
  double sliding_force = parameters_.coulomb;
  if (square < kBellIsOver) {
    sliding_force += (parameters_.break_away - parameters_.coulomb) * exp_nonpositive(-square);
  }
  const double stiffness = parameters_.bristle_stiffness;
  const double limit = std::copysign(sliding_force * per_stiffness_, velocity);
  const double travelled = stiffness * std::abs(velocity) * dt_s / sliding_force;
  const double before = bend_;
  bend_ = limit + (before - limit) * exp_nonpositive(-travelled);
  return stiffness * bend_ + parameters_.bristle_damping * (bend_ - before) / dt_s +
         parameters_.viscous * velocity;
}

}  // namespace tactus::host
