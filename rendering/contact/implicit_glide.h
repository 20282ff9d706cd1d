// One step of the proxy along a smooth implicit surface, corrected for its curvature.
// ImplicitTracker calls it where one tangent plane holds the proxy.
#pragma once

#include <optional>

#include "rendering/contact/implicit_sample.h"

namespace tactus::rendering {

// The proxy's position and its goal, in the object frame.
struct GlideStart {
  // The proxy, at its rest height.
  ImplicitSample from;
  // The sub-goal, on the tangent plane at `from`.
  Vec3 goal = Vec3::Zero();
  // The tool's projection on the tangent plane, from which the friction circle draws the goal back.
  Vec3 pulled_to = Vec3::Zero();
  // The tool; the step must come nearer to it.
  Vec3 tool = Vec3::Zero();
};

// Returns a surface point nearer to the tool in the direction of the goal, to which a free path
// leads. Returns nothing if the surface is not smooth enough here or the path is blocked.
//
// The goal is the tool's projection on the tangent plane. A step there and back to the surface
// multiplies the error by depth * curvature. In a hollow the sign changes, so that it never settles
// from depth * curvature = 1 on. The minimum of the distance over the surface's second-order shape
// is at the tangent step s with (1 - depth * S) s = u, where S is the shape operator and u the
// plain step. With s the error falls quadratically.
std::optional<ImplicitSample> glide(ImplicitField& field, const GlideStart& start);

}  // namespace tactus::rendering
