// The contribution of one object or effect of a scene at the tool: its stiffness and damping, their
// directions, and the region in which the tool feels it.
//
// Not for a tick. All are pure functions of their arguments, for any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware/safety/felt_region.h"
#include "rendering/effects/effect.h"
#include "rendering/needle/tissue.h"
#include "rendering/objects/object.h"

namespace tactus::firmware {

// A stiffness with a damping: those of a surface, or the largest stiffness that is certified with
// that damping.
struct CertifiedPoint {
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

// Two objects of the shared proxy whose sides are at most this far apart are in one place.
inline constexpr double kSamePlace_m = 1e-4;

// A wall of the workspace that is so far away does not count.
inline constexpr double kNoWall_m = 10.0;

// The box that the tool is kept in, world frame (safety/workspace_walls.h). The default has no
// walls.
struct FeltWalls {
  static constexpr std::size_t kCount = 6;

  Vec3 lower_W = Vec3::Constant(-kNoWall_m);  // m
  Vec3 upper_W = Vec3::Constant(kNoWall_m);
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  // The deepest position in a wall while the motors are on, m.
  double reach_m = 0.0;
};

// The tool and the settings that decide how a scene is felt.
struct SceneFeel {
  // The radius of the tool's sphere.
  double tool_radius_m = 0.0;
  // The largest force on the hand: a surface is felt until the force of its spring reaches it.
  double max_force_N = std::numeric_limits<double>::infinity();
  // A function that returns the material of an object, to replace the scene's; null for the
  // scene's.
  rendering::Material (*material)(const void* context, std::uint32_t object) = nullptr;
  // A function that returns the contact method of an object, to replace the scene's; null for the
  // scene's.
  rendering::ContactMethod (*method)(const void* context, std::uint32_t object) = nullptr;
  // The first argument of `material` and `method`.
  const void* context = nullptr;
  FeltWalls walls;
  // The needle with its tissues; it counts as a part of its first tissue.
  rendering::NeedleScene needle;
};

// A scene as the certificate sees it.
struct FeltScene {
  std::span<const rendering::Object> objects;
  std::span<const rendering::Effect> effects;
  SceneFeel feel;

  // Returns the number of parts: objects, effects and walls.
  [[nodiscard]] std::size_t size() const {
    return objects.size() + effects.size() + FeltWalls::kCount;
  }
};

// The directions of motion that a spring resists: all, only along its axis, or all across its axis.
enum class SpringDirections : std::uint8_t { all, along_axis, across_axis };

// The decrease of an effect's stiffness with the distance d from its middle.
struct Falloff {
  enum class Kind : std::uint8_t { none, pole, bounded_spring };
  Kind kind = Kind::none;
  // The pole, or the spring's anchor, world frame, m.
  Vec3 middle_W = Vec3::Zero();
  // The radius, m, within which a pole's pull is nearly a spring.
  double core_m = 0.0;
  // The stiffness at a pole's middle, N/m. It is multiplied by (1 + (d / core)^2)^(-3/2).
  double steepness = 0.0;
  // The largest force of a bounded spring, N. Divided by d it bounds the stiffness.
  double largest_force_N = 0;
};

// One part of a scene, as part_of() describes it.
struct ScenePart {
  // The largest stiffness and damping of the part.
  CertifiedPoint felt;
  Falloff falloff;
  SpringDirections directions = SpringDirections::all;
  // The unit axis of along_axis and across_axis, world frame.
  Vec3 axis_W = Vec3::Zero();
  FeltRegion region;
  // True for an object that the shared proxy touches.
  bool shares_proxy = false;
  // True if the sides of its box are its surface.
  bool has_flat_sides = false;
  // Its box; larger than kWorldBound_m on all sides if it moves.
  rendering::Bounds surface;
  // The distance from the surface at which the tool's centre is in contact, m.
  double contact_m = 0.0;
  // The box of a potential field, which pushes along the normals of its faces; else null.
  const rendering::Primitive* field_box = nullptr;
  // True for a wall of the workspace, which damps only along its own axis.
  bool is_wall = false;
};

// Returns part `number` of a scene. The objects come first, then the effects, then the workspace's
// walls.
ScenePart part_of(const FeltScene& scene, std::size_t number);

// Returns true if both share the proxy and their surfaces coincide, so that the proxy rests on both
// along one normal. For boxes along the axes and planes a common side is enough; other objects must
// have all sides of their boxes in common.
bool coincide(const ScenePart& a, const ScenePart& b);

}  // namespace tactus::firmware
