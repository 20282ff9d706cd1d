// The active constraints of a sub-goal: the contact planes that hold the proxy when it is as near
// to the tool as all planes allow, and the friction that they give together. It is the third step
// of a sub-goal (proxy_tick.cpp).
#pragma once

#include <array>

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/last_contact.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"
#include "rendering/friction/cone.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::rendering {

// The active planes and their joint friction.
struct ActiveConstraints {
  // The projection of the tool on the planes; world frame, m.
  PlaneProjection projection;
  // The spring between tool and proxy (corner_spring.h), N/m.
  double stiffness_N_per_m = 0.0;
  // The normal force of each active plane that friction sees, over that stiffness, m: its pressure
  // times its friction factor, and times the force of its own spring over that of the joint one.
  std::array<double, 3> push_m{};
  // The sum of the friction circles of the active planes, each of the radius mu times its push, m.
  FrictionCircle circle;
  // True if all materials of the active planes have the friction cone's exact rule.
  bool are_cones = true;
};

// Projects the tool `h` (world frame, m) on the planes at the proxy, and writes the planes that
// hold it, their pressures and their joint normal to `rest`.
ActiveConstraints find_active_constraints(const SceneObjects& scene, const FrictionFactors& factors,
                                          const ProxyState& state, const Vec3& h,
                                          ContactPlanes& planes, ProxyRest& rest);

// Returns the contact of `rest` with the largest pressure, by which objects that move carry the
// proxy in the next tick; none if no plane pushes.
LastContact hardest_contact(const ProxyRest& rest);

// Returns the surfaces of the planes that hold the proxy.
HeldBy holding_surfaces(const ProxyRest& rest);

// Makes the contact of the last tick hold the proxy in a tick that ended early, between two faces
// or while it waits for candidates. Its surface gives the force if the tool presses toward it. If
// the proxy moved far from it since, its nearest point gives the normal.
void keep_last_contact(const SceneObjects& scene, const LastContact& last_contact, const Vec3& p,
                       const Vec3& h, ProxyRest& rest);

}  // namespace tactus::rendering
