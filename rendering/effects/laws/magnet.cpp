#include "rendering/effects/laws/magnet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::rendering {

namespace {

// S of the magnet, N m^2: the pull S d / (d^2 + core^2)^(3/2) is strongest at core / sqrt(2).
double pole_strength(const Magnet& law, double most) {
  constexpr double kHalfOf3Root3 = 2.598076211353316;
  return kHalfOf3Root3 * std::clamp(law.strength_N, -most, most) * law.core_m * law.core_m;
}

}  // namespace

LawForce force_of(const Magnet& law, const LawInput& input) {
  const Vec3 to_pole = law.pole_W - input.tool.p_W;
  const double squared = to_pole.squaredNorm() + law.core_m * law.core_m;
  const double strength = pole_strength(law, input.max_force_N);
  return {.elastic_W = strength / (squared * std::sqrt(squared)) * to_pole};
}

double stored_by(const Magnet& law, const LawPlace& place) {
  const double strength = pole_strength(law, place.max_force_N);
  const double squared = (law.pole_W - place.p_W).squaredNorm() + law.core_m * law.core_m;
  const double to_infinity = -strength / std::sqrt(squared);
  return strength > 0.0 ? strength / law.core_m + to_infinity : to_infinity;
}

// The slope of the magnet's pull is S (c^2 - 2 d^2) / (d^2 + c^2)^(5/2) along the direction to the
// pole, and S / (d^2 + c^2)^(3/2) across it. A pole that pulls is a spring of S / c^3 at its
// middle, and across the direction elsewhere. A pole that pushes away is a spring along the
// direction. It is steepest at d^2 = 3 c^2 / 2, with -2 S / (5/2)^(5/2) / c^3, and below -2 S /
// (d^2 + c^2)^(3/2) at every distance.
LawSlopes steepest_of(const Magnet& law, double /*max_force_N*/) {
  const double middle = 1.5 * std::numbers::sqrt3 * law.strength_N / law.core_m;
  const double away = -2.0 / (2.5 * 2.5 * std::sqrt(2.5));
  return {.stiffness_N_per_m = middle >= 0.0 ? middle : away * middle};
}

}  // namespace tactus::rendering
