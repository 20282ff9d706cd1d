// Holds the proxy back by friction: from the point that the contact planes allow to the point that
// friction allows. It is the fourth step of a sub-goal (proxy_tick.cpp).
#pragma once

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/contact_planes.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/proxy_state.h"
#include "rendering/friction/cone.h"
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

// A sticking proxy may be this far below its rest height; a higher one clears the seams that it
// slides over next.
inline constexpr double kUnevenRest_m = 50e-9;

// Holds a proxy whose surfaces all have the friction cone's exact rule: they share one friction
// circle (friction/cone.h). Updates its friction state. `slipped` says that the proxy slipped
// earlier in this tick; it then slips in the rest of it. Inline, because nearly every sub-goal
// takes this path.
inline HeldGoal hold_by_circle(const ActiveConstraints& active, const Vec3& h,
                               ContactPlanes& planes, ProxyState& state, bool& slipped) {
  const PlaneProjection& projection = active.projection;
  const Vec3 from = projection.feasible ? planes.resting_position(state.p_W) : state.p_W;
  const FrictionStep step = apply_cone(from, projection.point, active.circle, state.friction);
  slipped = slipped || step.state == FrictionState::slip;
  state.friction = slipped ? FrictionState::slip : step.state;
  HeldGoal held{.point = step.goal, .tool = h};
  if (step.state == FrictionState::stick || !projection.feasible) {
    const double away = (step.goal - state.p_W).norm();
    held.settled = away <= kUnevenRest_m || !projection.feasible;
    held.sticks = true;
  }
  return held;
}

// Holds a proxy of which a surface has another friction model. Every object holds it by its own,
// under its own normal force (friction/joint_friction.h).
HeldGoal hold_by_model(const SceneObjects& scene, const ActiveConstraints& active,
                       const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                       ProxyState& state);

// Returns the goal of a proxy in contact, and updates its friction state.
inline HeldGoal hold_by_friction(const SceneObjects& scene, const ActiveConstraints& active,
                                 const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                                 ProxyState& state, bool& slipped) {
  return active.are_cones ? hold_by_circle(active, h, planes, state, slipped)
                          : hold_by_model(scene, active, rest, h, planes, state);
}

}  // namespace tactus::rendering
