#include "rendering/contact/implicit_friction.h"

#include "rendering/friction/cone.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// A shorter move counts as none: its force is a micronewton at 1000 N/m.
constexpr double kLeastMove_m = 1e-9;

}  // namespace

ImplicitGoal ImplicitFriction::hold(const ImplicitPush& push, const ImplicitPlanes& planes,
                                    const Vec3& h, const ImplicitSurface& surface,
                                    ImplicitProxyState& state) {
  return is_plain_cone(material_) ? stay_in_cone(push, surface, state)
                                  : lag_behind(push, planes, h, surface, state);
}

// Draws the goal back to the friction circle, whose radius is mu times the depth of the tool below
// the planes (friction/cone.h). The rule is applied in metres of the world, relative to the goal.
ImplicitGoal ImplicitFriction::stay_in_cone(const ImplicitPush& push,
                                            const ImplicitSurface& surface,
                                            ImplicitProxyState& state) {
  const PlaneProjection& projection = push.projection;
  const FrictionStep step =
      apply_cone(surface.scale_m * (state.p_O - projection.point), Vec3::Zero(),
                 {.static_radius_m = material_.friction.static_level * push.depth_m,
                  .dynamic_radius_m = material_.friction.coulomb * push.depth_m},
                 state.friction);
  slipped_ = slipped_ || step.state == FrictionState::slip;
  state.friction = slipped_ ? FrictionState::slip : step.state;
  const Vec3 goal = projection.point + step.goal / surface.scale_m;
  const bool settled = step.state == FrictionState::stick || !projection.feasible ||
                       (goal - state.p_O).norm() * surface.scale_m <= kLeastMove_m;
  return {.point = goal, .pulled_to = projection.point, .settled = settled};
}

// Lets the tool lag by what a friction model says: F = K lag along the surface. The goal is the
// point nearest to it in front of all planes: in a crease the lag may lead into a wall, which then
// takes that part of it.
ImplicitGoal ImplicitFriction::lag_behind(const ImplicitPush& push, const ImplicitPlanes& planes,
                                          const Vec3& h, const ImplicitSurface& surface,
                                          ImplicitProxyState& state) {
  SlidingSurface sliding = sliding_surface(material_);
  sliding.crease = push.crease_W;
  sliding.depth_m = (push.projection.point - h).norm() * surface.scale_m;
  const FrictionLag lag =
      state.model.lag(sliding, push.normal_W, material_.stiffness_N_per_m * push.depth_m);
  state.friction = lag.state;
  lag_O_ = surface.R_WO.transpose() * (lag.lag_m / surface.scale_m);
  const PlaneProjection projection = planes.project(h - lag_O_);
  const bool settled = !projection.feasible ||
                       (projection.point - state.p_O).norm() * surface.scale_m <= kLeastMove_m;
  return {.point = projection.point, .pulled_to = projection.point, .settled = settled};
}

}  // namespace tactus::rendering
