// An implicit surface as the proxy finds it under itself.
#pragma once

#include <optional>

#include "rendering/contact/first_crossing.h"

namespace tactus::rendering {

// The proxy rests this far above the surface, so that the sign of F is never in doubt there. Metres
// of the world; along the gradient, to first order.
inline constexpr double kImplicitRest_m = 1e-7;
// A proxy nearer to the surface than this, in metres of the world, is in contact.
inline constexpr double kImplicitReach_m = 2e-7;

// F and its gradient at a point, in the object frame.
struct ImplicitSample {
  Vec3 point = Vec3::Zero();
  double value = 0.0;          // F, >= 0 where the proxy may be
  double steepness = 0.0;      // |gradient|; 0 at a singular point
  Vec3 normal = Vec3::Zero();  // unit, away from the surface; zero at a singular point
  double height = 0.0;         // F / |gradient|: the distance to the surface, to first order;
                               // infinite at a singular point
};

ImplicitSample sample(ImplicitField& field, const Vec3& p_O);

// The point that Newton's steps along the gradient reach from p_O at the height at which the proxy
// rests. Nothing if they meet a singular point, do not converge, or one is longer than `most`.
std::optional<ImplicitSample> settle_at_rest(ImplicitField& field, Vec3 p_O, double most);

}  // namespace tactus::rendering
