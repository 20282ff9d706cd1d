#include "rendering/contact/friction_hold.h"

#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
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

}  // namespace tactus::rendering
