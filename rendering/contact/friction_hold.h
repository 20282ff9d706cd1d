// Holds the proxy back by friction: from the point that the contact planes allow to the point that
// friction allows. It is the fourth step of a sub-goal (sphere_proxy.cpp).
#pragma once

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/contact_planes.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::rendering {

// The goal that friction leaves to the proxy; world frame, m.
struct HeldGoal {
  // The point to which the proxy moves.
  Vec3 point = Vec3::Zero();
  // The tool that the proxy follows: a friction model makes it lag behind the real one.
  Vec3 tool = Vec3::Zero();
  // True if the proxy stays where it is.
  bool settled = false;
  // True if the proxy moves to its rest height only, not along the surface.
  bool sticks = false;
};

// Returns the goal of a proxy in contact, and updates its friction state. All surfaces with the
// friction cone's exact rule share one friction circle (friction/cone.h). Otherwise the surface
// with the largest pressure supplies the model, under the push of all surfaces
// (friction/surface_friction.h). `slipped` says that the proxy slipped earlier in this tick; it
// then slips in the rest of it.
HeldGoal hold_by_friction(const SceneObjects& scene, const ActiveConstraints& active,
                          const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                          ProxyState& state, bool& slipped);

}  // namespace tactus::rendering
