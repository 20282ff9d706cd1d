#include "rendering/contact/friction_hold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <Eigen/Geometry>

#include "rendering/friction/joint_friction.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// Returns the direction of the crease between the two planes that hold the proxy, unit. It is zero
// if another number of planes does, or if they are nearly parallel.
Vec3 crease_of(const ProxyRest& rest) {
  constexpr double kLeastSquaredSine = 1e-6;
  if (rest.plane_count != 2) {
    return Vec3::Zero();
  }
  const Vec3 along = rest.planes[0].plane.normal.cross(rest.planes[1].plane.normal);
  const double squared = along.squaredNorm();
  return squared > kLeastSquaredSine ? Vec3{along / std::sqrt(squared)} : Vec3{Vec3::Zero()};
}

}  // namespace

// Lets the tool lag by what the friction models say; the goal is the point nearest to it in front
// of all planes. In a corner the lag may lead into a wall, which then takes that part of it.
HeldGoal hold_by_model(const SceneObjects& scene, const ActiveConstraints& active,
                       const ProxyRest& rest, const Vec3& h, ContactPlanes& planes,
                       ProxyState& state) {
  const Vec3 crease = crease_of(rest);
  std::array<JointSurface, JointFriction::kMost> surfaces;
  std::size_t count = 0;
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
