#include "rendering/contact/implicit_sample.h"

#include <cmath>
#include <limits>

namespace tactus::rendering {

ImplicitSample sample(ImplicitField& field, const Vec3& p_O) {
  const ValueAndGradient f = field.value_and_gradient(p_O);
  ImplicitSample s{.point = p_O,
                   .value = f.value,
                   .steepness = f.gradient.stableNorm(),
                   .height = std::numeric_limits<double>::infinity()};
  if (s.steepness > 0.0) {
    s.normal = f.gradient / s.steepness;
    s.height = f.value / s.steepness;
  }
  return s;
}

std::optional<ImplicitSample> settle_at_rest(ImplicitField& field, Vec3 p_O, double most) {
  constexpr int kMostSteps = 6;
  constexpr double kGood = 0.01;
  // Beside a singular point the height is less than the distance and the steps fall short.
  constexpr double kGoodEnough = 0.5;
  const double rest = kImplicitRest_m / field.surface().scale_m;
  for (int step = 0;; ++step) {
    const ImplicitSample s = sample(field, p_O);
    const double rise = rest - s.height;
    if (!(s.steepness > 0.0) || !(std::abs(rise) <= most)) {
      return std::nullopt;
    }
    if (std::abs(rise) <= (step < kMostSteps ? kGood : kGoodEnough) * rest) {
      return s;
    }
    if (step == kMostSteps) {
      return std::nullopt;
    }
    p_O += rise * s.normal;
  }
}

}  // namespace tactus::rendering
