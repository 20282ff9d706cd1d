// An implicit surface as the proxy finds it under itself: value, normal and height of F at a point.
// ImplicitTracker (implicit_tracking.h) rests on it; implicit_glide.h and implicit_segment.h use it
// for the ends of their moves.
#pragma once

#include <array>
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
  // F, in the formula's own unit; >= 0 where the proxy may be.
  double value = 0.0;
  // grad F|, 1 per unit of length; 0 at a singular point, which has no normal.
  double steepness = 0.0;
  // The unit vector grad F / |grad F|, away from the surface; zero at a singular point.
  Vec3 normal = Vec3::Zero();
  // F / |grad F|, the distance to the surface to first order, in the object's unit of length;
  // infinite at a singular point.
  double height = 0.0;
};

// Evaluates F and its gradient at p_O, at the cost of one evaluation.
ImplicitSample sample(ImplicitField& field, const Vec3& p_O);

// Evaluates F and its gradient at two points, at the cost of less than two evaluations.
std::array<ImplicitSample, 2> two_samples(ImplicitField& field, const Vec3& p_O, const Vec3& q_O);

// Returns the point that Newton's steps along the gradient reach from p_O, at the height at which
// the proxy rests. It returns nothing if the steps meet a singular point, do not converge, or if
// one of them is longer than `most` (object frame, its unit of length). The path there is not
// checked.
std::optional<ImplicitSample> settle_at_rest(ImplicitField& field, Vec3 p_O, double most);

}  // namespace tactus::rendering
