// The contact points of two bodies, or of a body and a plane: up to four, with one normal.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/bodies/placed_hull.h"

namespace tactus::rendering {

// The most points of a manifold. Beyond: the deepest and those that span the largest area stay.
inline constexpr std::size_t kManifoldPoints = 4;

// A point where two surfaces meet, or nearly do.
struct ManifoldPoint {
  // The middle between the two surfaces, world frame, m.
  Vec3 point_W = Vec3::Zero();
  // The distance of the surfaces along the normal, m; < 0 where they overlap.
  double separation_m = 0.0;
};

// The contact of solid A with solid B.
struct Manifold {
  // The unit normal from A to B.
  Vec3 normal_W = Vec3::UnitY();
  std::array<ManifoldPoint, kManifoldPoints> points;
  std::size_t count = 0;
};

// Returns the points where two solids are nearer than `margin_m`, >= 0.
Manifold manifold_of(const PlacedHull& a, const PlacedHull& b, double margin_m);

// Returns the points where a solid is nearer than `margin_m` to the half space below a plane
// through `point_W` with the unit normal `normal_W`; A is the half space.
Manifold manifold_of(const Vec3& point_W, const Vec3& normal_W, const PlacedHull& b,
                     double margin_m);

}  // namespace tactus::rendering
