// An implicit surface as the proxy finds it under itself.
#pragma once

#include "rendering/contact/first_crossing.h"

namespace tactus::rendering {

// The proxy rests this far above the surface, so that the sign of F is never in doubt there. Metres
// of the world; along the gradient, to first order.
inline constexpr double kImplicitRest_m = 1e-7;
// Nearer than this is contact.
inline constexpr double kImplicitReach_m = 2e-7;

// F and its gradient at a point, in the object frame.
struct ImplicitSample {
  Vec3 point = Vec3::Zero();
  double value = 0.0;  // F, >= 0 where the proxy may be
  Vec3 gradient = Vec3::Zero();
  double steepness = 0.0;      // |gradient|; 0 at a singular point
  Vec3 normal = Vec3::Zero();  // unit, away from the surface; zero at a singular point
  double height = 0.0;         // F / |gradient|: the distance to the surface, to first order
};

inline ImplicitSample sample(ImplicitField& field, const Vec3& p_O) {
  const ValueAndGradient f = field.value_and_gradient(p_O);
  ImplicitSample s{
      .point = p_O, .value = f.value, .gradient = f.gradient, .steepness = f.gradient.stableNorm()};
  if (s.steepness > 0.0) {
    s.normal = f.gradient / s.steepness;
    s.height = f.value / s.steepness;
  }
  return s;
}

}  // namespace tactus::rendering
