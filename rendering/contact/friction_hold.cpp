#include "rendering/contact/friction_hold.h"

#include <algorithm>
#include <array>
#include <span>

#include "rendering/friction/joint_friction.h"
#include "rendering/geometry/tangential.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {

// Lets the tool lag by what the friction models say; the goal is the point nearest to it in front
// of all planes. In a corner the lag may lead into a wall, which then takes that part of it.
HeldGoal hold_by_model(const SceneObjects& scene, const ActiveConstraints& active,
                       const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                       ProxyState& state) {
  const Vec3 crease = rest.plane_count == 2
                          ? crease_between(rest.planes[0].plane.normal, rest.planes[1].plane.normal)
                          : Vec3{Vec3::Zero()};
  std::array<JointSurface, JointFriction::kMost> surfaces;
  std::size_t count = 0;
  Vec3 push_W = Vec3::Zero();
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    const std::uint32_t object = rest.planes[i].object;
    const auto end = surfaces.begin() + count;
    auto place = std::find_if(surfaces.begin(), end,
                              [&](const JointSurface& other) { return other.number == object; });
    if (place == end) {
      *place = {.number = object, .sliding = sliding_surface(scene.material(object))};
      place->sliding.stiffness_N_per_m = active.stiffness_N_per_m;
      place->sliding.crease = crease;
      // The grain turns with an object that moves.
      Grain& grain = place->sliding.grain;
      grain.direction = direction_from(scene.mover_of(object), grain.direction);
      ++count;
    }
    place->normal_force_N += active.stiffness_N_per_m * active.push_m[i];
    push_W += active.push_m[i] * rest.planes[i].plane.normal;
  }
  for (JointSurface& surface : std::span(surfaces).first(count)) {
    surface.sliding.depth_m = push_W.norm();
  }
  const FrictionLag joint = state.models.lag(std::span(surfaces).first(count), rest.normal_W);
  state.friction = joint.state;
  const Vec3 lagging = h - joint.lag_m;
  const PlaneProjection projection = planes.project(state.p_W, lagging);
  if (!projection.feasible) {
    return {.point = state.p_W, .tool = h, .settled = true, .sticks = true};
  }
  return {.point = projection.point, .tool = lagging};
}

}  // namespace tactus::rendering
