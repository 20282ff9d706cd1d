// The friction of a steady slip at a speed, without the viscous term, N per N of normal force.
#pragma once

#include "rendering/friction/friction_parameters.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {

// exp(-x) for x >= 0; 0 where that is below a double's rounding of 1.
inline double bell(double x) {
  constexpr double kBellIsOver = 37.0;  // 6.1 widths of exp(-x^2)
  return x < kBellIsOver ? exponential(-x) : 0.0;
}

// Fs at rest, Fc at any speed.
inline double falling_at_once(const FrictionParameters& p, double speed_m_per_s) {
  return speed_m_per_s > 0.0 ? p.coulomb : p.static_level;
}

// g(v) = Fc + (Fs - Fc) exp(-|v/vs|^alpha): Stribeck's curve.
inline double falling_with_speed(const FrictionParameters& p, double speed_m_per_s) {
  const double ratio = speed_m_per_s / p.stribeck_velocity_m_per_s;
  if (!(ratio > 0.0)) {
    return p.static_level;
  }
  const double exponent = p.stribeck_exponent == 2.0
                              ? ratio * ratio
                              : exponential(p.stribeck_exponent * logarithm(ratio));
  return p.coulomb + (p.static_level - p.coulomb) * bell(exponent);
}

}  // namespace tactus::rendering
