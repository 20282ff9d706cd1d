#include "firmware/safety/scene_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "firmware/safety/object_part.h"
#include "rendering/limits.h"

namespace tactus::firmware {
namespace {

Falloff falloff_of(const rendering::Magnet& magnet) {
  const double middle = 1.5 * std::numbers::sqrt3 * magnet.strength_N / magnet.core_m;
  return {.kind = Falloff::Kind::pole,
          .middle_W = magnet.pole_W,
          .core_m = magnet.core_m,
          .steepness = middle >= 0.0 ? middle : -2.0 * middle};
}

// Returns the falloff of a spring with a largest force. Beyond the distance at which it reaches
// that force, its force only changes direction.
Falloff falloff_of(const rendering::Spring& spring, double largest_force_N) {
  return {.kind = Falloff::Kind::bounded_spring,
          .middle_W = spring.anchor_W,
          .largest_force_N = largest_force_N};
}

rendering::Bounds around(const Vec3& p_W, double by_m) {
  return grown({.lower_W = p_W, .upper_W = p_W}, by_m);
}

// Returns the region in which a line captures the tool. The line is infinite, so it is a box only
// if the line is along an axis of the world.
FeltRegion region_of(const rendering::SnapToLine& line) {
  FeltRegion region;
  const rendering::Bounds near = around(line.point_W, line.law.capture_m);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(line.direction_W[axis]) < kSameDirection) {
      region.box.lower_W[axis] = near.lower_W[axis];
      region.box.upper_W[axis] = near.upper_W[axis];
    }
  }
  return region;
}

// A magnet is felt up to this many cores from its pole: the slope of the pull is then a hundredth
// of that in the middle.
constexpr double kCoresFelt = 4.6;

FeltRegion region_of(const rendering::FluidDrag& drag) {
  const rendering::Primitive& volume = drag.volume;
  return volume.kind == rendering::PrimitiveKind::plane
             ? slab(volume.X_WO.translation, volume.X_WO.rotation.col(1), kBoundless_m, 0.0)
             : FeltRegion{.box = rendering::bounds(volume)};
}

FeltRegion region_of(const rendering::SnapToPoint& point) {
  return {.box = around(point.point_W, point.law.capture_m)};
}

// Narrows a part that is felt everywhere in all directions to where and how the tool feels the law.
// A law without such a function stays as it is.
void narrow(ScenePart& /*part*/, const auto& /*law*/, double /*max_force_N*/) {}

void narrow(ScenePart& part, const rendering::Spring& law, double max_force_N) {
  part.falloff = falloff_of(law, max_force_N);
}

void narrow(ScenePart& part, const rendering::SpringDamper& law, double max_force_N) {
  part.falloff = falloff_of(law.spring, max_force_N);
}

void narrow(ScenePart& part, const rendering::Magnet& law, double /*max_force_N*/) {
  part.falloff = falloff_of(law);
  part.region.box = around(law.pole_W, kCoresFelt * law.core_m);
}

void narrow(ScenePart& part, const rendering::FluidDrag& law, double /*max_force_N*/) {
  part.region = region_of(law);
}

void narrow(ScenePart& part, const rendering::SnapToPoint& law, double /*max_force_N*/) {
  part.region = region_of(law);
}

// The stiffness is I - d d^T, which is zero along the line.
void narrow(ScenePart& part, const rendering::SnapToLine& law, double /*max_force_N*/) {
  part.directions = SpringDirections::across_axis;
  part.axis_W = law.direction_W;
  part.region = region_of(law);
}

void narrow(ScenePart& part, const rendering::SnapToPlane& law, double /*max_force_N*/) {
  part.directions = SpringDirections::along_axis;
  part.axis_W = law.normal_W;
  part.region = slab(law.point_W, law.normal_W, law.law.capture_m, law.law.capture_m);
}

// Returns true if sides along one axis are in contact with the tool at the same position of its
// centre.
bool common_side(const ScenePart& a, const ScenePart& b, Eigen::Index axis) {
  const auto same = [](double one, double other) {
    return std::abs(one) < rendering::kWorldBound_m && std::abs(one - other) < kSamePlace_m;
  };
  return same(a.surface.lower_W[axis] - a.contact_m, b.surface.lower_W[axis] - b.contact_m) ||
         same(a.surface.upper_W[axis] + a.contact_m, b.surface.upper_W[axis] + b.contact_m);
}

// Returns true if the sides have an area in common. Sides that only meet at an edge, as those of
// tiles do, have none.
bool common_area(const rendering::Bounds& common, Eigen::Index across) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (axis != across && common.upper_W[axis] - common.lower_W[axis] < kSamePlace_m) {
      return false;
    }
  }
  return true;
}

// Returns true if the boxes and the contact distances are the same.
bool same_box(const ScenePart& a, const ScenePart& b) {
  const auto far = [](const Vec3& p, const Vec3& q) { return (p - q).cwiseAbs().maxCoeff(); };
  return std::max(far(a.surface.lower_W, b.surface.lower_W),
                  far(a.surface.upper_W, b.surface.upper_W)) < kSamePlace_m &&
         std::abs(a.contact_m - b.contact_m) < kSamePlace_m &&
         a.surface.upper_W.maxCoeff() < kBoundless_m;
}

// Returns true if the planes are the same, with the same side outward.
bool same_plane(const FeltRegion& a, const FeltRegion& b) {
  return a.normal_W.dot(b.normal_W) > 1.0 - kSameDirection &&
         std::abs(a.highest_m - b.highest_m) < kSamePlace_m;
}

// Returns the part of an effect by the kind of its law.
ScenePart part_of_effect(const rendering::Effect& effect) {
  const rendering::LawSlopes slopes = rendering::steepest(effect);
  ScenePart part{.felt = {.damping_Ns_per_m = slopes.damping_Ns_per_m,
                          .stiffness_N_per_m = slopes.stiffness_N_per_m}};
  visit_alternative(effect.law, [&](const auto& law) { narrow(part, law, effect.max_force_N); });
  return part;
}

// Returns a wall of the workspace. Wall 0 is the lower one across x, wall 1 the upper one, then y
// and z. A wall that no device can reach does not count.
ScenePart part_of_wall(const FeltWalls& walls, std::size_t wall) {
  const auto axis = static_cast<Eigen::Index>(wall / 2);
  const bool is_upper = wall % 2 == 1;
  const double place_m = is_upper ? walls.upper_W[axis] : walls.lower_W[axis];
  if (!(std::abs(place_m) < kNoWall_m)) {
    return {.is_wall = true};
  }
  ScenePart part{.felt = {.damping_Ns_per_m = walls.damping_Ns_per_m,
                          .stiffness_N_per_m = walls.stiffness_N_per_m},
                 .directions = SpringDirections::along_axis,
                 .axis_W = Vec3::Unit(axis),
                 .is_wall = true};
  part.region.box = grown({.lower_W = walls.lower_W, .upper_W = walls.upper_W}, walls.reach_m);
  (is_upper ? part.region.box.lower_W : part.region.box.upper_W)[axis] = place_m;
  return part;
}

}  // namespace

ScenePart part_of(const FeltScene& scene, std::size_t number) {
  if (number >= scene.objects.size() + scene.effects.size()) {
    return part_of_wall(scene.feel.walls, number - scene.objects.size() - scene.effects.size());
  }
  if (number >= scene.objects.size()) {
    return part_of_effect(scene.effects[number - scene.objects.size()]);
  }
  const auto object = static_cast<std::uint32_t>(number);
  const SceneFeel& feel = scene.feel;
  rendering::Object felt = scene.objects[number];
  felt.material = feel.material == nullptr ? felt.material : feel.material(feel.context, object);
  felt.method = feel.method == nullptr ? felt.method : feel.method(feel.context, object);
  ScenePart part = part_of_object(felt, felt.material, feel);
  if (part.field_box != nullptr) {
    part.field_box = &scene.objects[number].primitive;  // which outlives the copy
  }
  return part;
}

bool coincide(const ScenePart& a, const ScenePart& b) {
  if (!a.shares_proxy || !b.shares_proxy) {
    return false;
  }
  if (!a.has_flat_sides || !b.has_flat_sides) {
    return same_box(a, b);
  }
  if (!a.region.normal_W.isZero() && !b.region.normal_W.isZero()) {
    return same_plane(a.region, b.region);
  }
  const rendering::Bounds common = common_box(a.surface, b.surface);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (common_side(a, b, axis) && common_area(common, axis)) {
      return true;
    }
  }
  return false;
}

}  // namespace tactus::firmware
