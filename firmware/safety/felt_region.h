// Regions of the scene, world frame, for the check of a scene against the certificate. Not for a
// tick. All are pure functions of their arguments, for any thread.
#pragma once

#include "rendering/surface/primitive_parts.h"

namespace tactus::firmware {

// A distance beyond the world.
inline constexpr double kBoundless_m = 1e3;

// Tolerance within which a direction is an axis of the world, or two planes are parallel.
inline constexpr double kSameDirection = 1e-9;

// The region in which the tool feels a part, world frame. The tool is in the box and, if there is a
// normal, its coordinate along the normal is between lowest_m and highest_m.
struct FeltRegion {
  rendering::Bounds box{.lower_W = Vec3::Constant(-kBoundless_m),
                        .upper_W = Vec3::Constant(kBoundless_m)};
  // A unit vector, or zero: the region is then the whole box.
  Vec3 normal_W = Vec3::Zero();
  // The range of the coordinate along the normal, m.
  double lowest_m = -kBoundless_m;
  double highest_m = kBoundless_m;
};

// Returns the box, larger by `by_m` on each side.
rendering::Bounds grown(const rendering::Bounds& box, double by_m);

// Returns the region between two planes, `below_m` and `above_m` from the point along the normal.
FeltRegion slab(const Vec3& point_W, const Vec3& normal_W, double below_m, double above_m);

// Returns the intersection of both boxes; lower is above upper if it is empty.
rendering::Bounds common_box(const rendering::Bounds& a, const rendering::Bounds& b);

// Returns true if some point of the box is in the region. The box lies in the region's box.
bool has_point_in(const rendering::Bounds& box, const FeltRegion& region);

}  // namespace tactus::firmware
