// What one object or effect of a scene adds where the tool is: how stiff and how damped it is, in
// which directions, and where the tool must be to feel it.
//
// Not for a tick. Pure functions of their arguments; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rendering/effects/effect.h"
#include "rendering/world/object.h"

namespace tactus::firmware {

// A stiffness with a damping: what a surface has, or the most that is certified with that damping.
struct CertifiedPoint {
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

// Two objects of the shared proxy whose sides are as near as this are in one place.
inline constexpr double kSamePlace_m = 1e-4;

inline constexpr double kBoundless_m = 1e3;  // beyond the world

inline constexpr double kNoWall_m = 10.0;  // a wall of the workspace so far away is not there

// The box that the tool is kept in (safety/workspace_walls.h); without a change, none.
struct FeltWalls {
  static constexpr std::size_t kCount = 6;

  Vec3 lower_W = Vec3::Constant(-kNoWall_m);  // m
  Vec3 upper_W = Vec3::Constant(kNoWall_m);
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double reach_m = 0.0;  // how deep in a wall the tool can be while the motors are on
};

// How a scene is felt.
struct SceneFeel {
  double tool_radius_m = 0.0;
  // A surface is felt until the force of its spring is this large.
  double max_force_N = std::numeric_limits<double>::infinity();
  // The material of an object in place of the scene's; null for the scene's.
  rendering::Material (*material)(const void* context, std::uint32_t object) = nullptr;
  const void* context = nullptr;
  FeltWalls walls;
};

struct FeltScene {
  std::span<const rendering::Object> objects;
  std::span<const rendering::Effect> effects;
  SceneFeel feel;

  [[nodiscard]] std::size_t size() const {
    return objects.size() + effects.size() + FeltWalls::kCount;
  }
};

// Where the tool is when it feels the part: in the box and, if it has a normal, at a height along
// it between the two. World frame.
struct FeltRegion {
  rendering::Bounds box{.lower_W = Vec3::Constant(-kBoundless_m),
                        .upper_W = Vec3::Constant(kBoundless_m)};
  Vec3 normal_W = Vec3::Zero();  // unit, or zero
  double lowest_m = -kBoundless_m;
  double highest_m = kBoundless_m;
};

// Which moves of the tool a spring answers.
enum class SpringDirections : std::uint8_t { all, along_axis, across_axis };

// How the stiffness of an effect falls with the distance from its middle.
struct Falloff {
  enum class Kind : std::uint8_t { none, pole, bounded_spring };
  Kind kind = Kind::none;
  Vec3 middle_W = Vec3::Zero();
  double core_m = 0.0;         // of a pole
  double steepness = 0.0;      // of a pole, N/m: times (1 + (d / core)^2)^(-3/2)
  double largest_force_N = 0;  // of a bounded spring: over d
};

struct ScenePart {
  CertifiedPoint felt;  // the most
  Falloff falloff;
  SpringDirections directions = SpringDirections::all;
  Vec3 axis_W = Vec3::Zero();  // unit, of along_axis and across_axis
  FeltRegion region;
  // Of an object that meets the shared proxy.
  bool shares_proxy = false;
  bool has_flat_sides = false;  // its box's sides are its own surface
  rendering::Bounds surface;    // its box; beyond kWorldBound_m to all sides for one that moves
  double contact_m = 0.0;       // the distance at which the tool's centre is in contact with it
  // Of a potential field of a box: the box, which pushes along the normals of its faces; else null.
  const rendering::Primitive* field_box = nullptr;
  bool is_wall = false;  // of the workspace: damps along its own axis alone
};

// Part `number` of a scene: its objects come first, then its effects, then the workspace's walls.
ScenePart part_of(const FeltScene& scene, std::size_t number);

// Whether both share the proxy and the surfaces coincide: where they do, the proxy rests on both
// along one normal. For boxes along the axes and planes a common side is enough; every other
// object must have all the sides of its box in common.
bool coincide(const ScenePart& a, const ScenePart& b);

// The box that both have in common; lower above upper where there is none.
rendering::Bounds common_box(const rendering::Bounds& a, const rendering::Bounds& b);

// Whether some point of the box is in the region. The box lies in the region's box.
bool has_point_in(const rendering::Bounds& box, const FeltRegion& region);

}  // namespace tactus::firmware
