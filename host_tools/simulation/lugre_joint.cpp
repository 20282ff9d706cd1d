#include "host_tools/simulation/lugre_joint.h"

#include <cmath>

#include "host_tools/simulation/portable_math.h"

namespace tactus::host {
namespace {

// g(v): the friction of steady sliding. Beyond 6.1 Stribeck velocities the bell is below a double's
// rounding of 1.
double sliding_force(const LuGreParameters& p, double velocity) {
  constexpr double kBellIsOver = 37.0;
  const double ratio = velocity / p.stribeck_velocity;
  const double exponent = ratio * ratio;
  if (exponent > kBellIsOver) {
    return p.coulomb;
  }
  return p.coulomb + (p.break_away - p.coulomb) * exp_nonpositive(-exponent);
}

}  // namespace

// dz/dt = v - sigma0 |v| z / g(v) has, for constant v, the solution z = s g/sigma0 + (z0 - s
// g/sigma0) exp(-a) with s = sgn(v) and a = sigma0 |v| dt / g.
double LuGreJoint::advance(double velocity, double dt_s) {
  if (parameters_.coulomb <= 0.0) {
    return parameters_.viscous * velocity;
  }
  const double force = sliding_force(parameters_, velocity);
  const double limit = std::copysign(force / parameters_.bristle_stiffness, velocity);
  const double travelled = parameters_.bristle_stiffness * std::abs(velocity) * dt_s / force;
  const double before = bend_;
  bend_ = limit + (before - limit) * exp_nonpositive(-travelled);
  return parameters_.bristle_stiffness * bend_ +
         parameters_.bristle_damping * (bend_ - before) / dt_s + parameters_.viscous * velocity;
}

}  // namespace tactus::host
