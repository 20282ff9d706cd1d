#include "rendering/contact/implicit_sample.h"

#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

// The height F / |grad F| is the distance to the surface to first order. stableNorm() does not
// overflow where a formula is steep.
ImplicitSample sample_of(const ValueAndGradient& f, const Vec3& p_O) {
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

}  // namespace

ImplicitSample sample(ImplicitField& field, const Vec3& p_O) {
  return sample_of(field.value_and_gradient(p_O), p_O);
}

std::array<ImplicitSample, 2> two_samples(ImplicitField& field, const Vec3& p_O, const Vec3& q_O) {
  const auto f = field.values_and_gradients(p_O, q_O);
  return {sample_of(f[0], p_O), sample_of(f[1], q_O)};
}

std::optional<ImplicitSample> settle_at_rest(ImplicitField& field, Vec3 p_O, double most) {
  // A step is over when the height is within 1 % of the rest height. After the last one half is
  // enough: beside a singular point the height is less than the distance and the steps fall short.
  constexpr int kMostSteps = 6;
  constexpr double kGood = 0.01;
  constexpr double kGoodEnough = 0.5;
  const double rest = kImplicitRest_m / field.surface().scale_m;
  for (int step = 0;; ++step) {
    ImplicitSample s = sample(field, p_O);
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
    // Newton's method along the gradient: the height is exact if F is a distance.
    p_O += rise * s.normal;
  }
}

}  // namespace tactus::rendering
