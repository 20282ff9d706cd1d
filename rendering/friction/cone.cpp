#include "rendering/friction/cone.h"

namespace tactus::rendering {

FrictionStep apply_cone(const Vec3& proxy, const Vec3& frictionless, const FrictionCircle& circle,
                        FrictionState state) {
  // A slipping proxy is put on the rim itself; rounding must not move it again.
  constexpr double kRim = 1.0 + 1e-9;
  constexpr double kStill_m = 1e-9;
  const Vec3 lag = proxy - frictionless;
  const double distance = lag.norm();
  const double hold =
      state == FrictionState::slip ? circle.dynamic_radius_m : circle.static_radius_m;
  if (distance <= hold * kRim + kStill_m) {
    return {.goal = proxy, .state = FrictionState::stick};
  }
  // A dynamic circle larger than the static one must not push the proxy outwards.
  const double scale =
      circle.dynamic_radius_m < distance ? circle.dynamic_radius_m / distance : 1.0;
  return {.goal = frictionless + scale * lag, .state = FrictionState::slip};
}

}  // namespace tactus::rendering
