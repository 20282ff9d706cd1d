#include "rendering/contact/friction_hold.h"

#include "rendering/friction/cone.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// A sticking proxy may be this far below its rest height; a higher one clears the seams that it
// slides over next.
constexpr double kUnevenRest_m = 50e-9;

// Holds the proxy by the joint friction circle. Its centre is the frictionless goal, its radius mu
// times the pressures. A proxy inside sticks where it is, one outside slips to the rim.
HeldGoal hold_by_circle(const ActiveConstraints& active, const Vec3& h, ContactPlanes& planes,
                        ProxyState& state, bool& slipped) {
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

// Lets the goal lag behind the frictionless one by what a friction model says. The model takes one
// surface: the object with the largest pressure gives the parameters, and the normal force is that
// of all surfaces, with the mean of their stiffnesses weighted by the pressures.
HeldGoal hold_by_model(const SceneObjects& scene, const ActiveConstraints& active,
                       const ProxyRest& rest, const Vec3& h, ProxyState& state) {
  double stiffness = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    stiffness += rest.pressure_m[i] * scene.material(rest.planes[i].object).stiffness_N_per_m;
    total += rest.pressure_m[i];
  }
  const std::uint32_t object = rest.planes[rest.hardest()].object;
  SlidingSurface surface = sliding_surface(scene.material(object));
  surface.stiffness_N_per_m = stiffness / total;
  // The grain turns with an object that moves.
  surface.grain.direction = direction_from(scene.mover_of(object), surface.grain.direction);
  const FrictionLag lag =
      state.model.lag(surface, rest.normal_W, surface.stiffness_N_per_m * active.push_m);
  state.friction = lag.state;
  if (!active.projection.feasible) {
    return {.point = state.p_W, .tool = h, .settled = true, .sticks = true};
  }
  return {.point = active.projection.point - lag.lag_m, .tool = h - lag.lag_m};
}

}  // namespace

HeldGoal hold_by_friction(const SceneObjects& scene, const ActiveConstraints& active,
                          const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                          ProxyState& state, bool& slipped) {
  return active.are_cones ? hold_by_circle(active, h, planes, state, slipped)
                          : hold_by_model(scene, active, rest, h, state);
}

}  // namespace tactus::rendering
