#include "rendering/contact/implicit_sample.h"

#include <cmath>

namespace tactus::rendering {

ImplicitSample sample(ImplicitField& field, const Vec3& p_O) {
  const ValueAndGradient f = field.value_and_gradient(p_O);
  ImplicitSample s{.point = p_O, .value = f.value, .steepness = f.gradient.stableNorm()};
  if (s.steepness > 0.0) {
    s.normal = f.gradient / s.steepness;
    s.height = f.value / s.steepness;
  }
  return s;
}

std::optional<ImplicitSample> settle_at_rest(ImplicitField& field, Vec3 p_O, double most) {
  constexpr int kMostSteps = 5;
  constexpr double kTolerance = 0.01;
  const double rest = kImplicitRest_m / field.surface().scale_m;
  for (int step = 0; step < kMostSteps; ++step) {
    const ImplicitSample s = sample(field, p_O);
    const double rise = rest - s.height;
    if (!(s.steepness > 0.0) || !(std::abs(rise) <= most)) {
      return std::nullopt;
    }
    if (std::abs(rise) <= kTolerance * rest) {
      return s;
    }
    p_O += rise * s.normal;
  }
  return std::nullopt;
}

}  // namespace tactus::rendering
