// One step of the proxy along a smooth implicit surface, corrected for its curvature.
#pragma once

#include <optional>

#include "rendering/contact/implicit_sample.h"

namespace tactus::rendering {

// Where the proxy is and wants to go, in the object frame.
struct GlideWish {
  ImplicitSample from;
  Vec3 goal = Vec3::Zero();  // on the tangent plane at `from`
  Vec3 tool = Vec3::Zero();
};

// A surface point further along toward the goal that is nearer to the tool, and to which a way
// leads that meets nothing; nothing if the surface is not smooth enough here, or something is in
// the way.
//
// The goal is where the tool projects on the tangent plane. Going there and back down to the
// surface multiplies the error by depth * curvature (in a hollow with the sign changed, so that
// from depth * curvature = 1 on it never settles). The minimum of the distance over the surface's
// second-order shape is at the tangent step s with (1 - depth * S) s = u, S the shape operator and
// u the plain step: with it the error falls quadratically.
std::optional<ImplicitSample> glide(ImplicitField& field, const GlideWish& wish);

}  // namespace tactus::rendering
