// The distance between the vertices' hulls of two convex solids, and the axis along which they
// overlap least. Radii are left to the caller (manifold.h).
#pragma once

#include "rendering/bodies/placed_hull.h"

namespace tactus::rendering {

// The nearest points of two hulls, or the deepest ones of two that overlap.
struct HullSeparation {
  // The distance, m; < 0 for hulls that overlap: how far they must be moved apart along the normal.
  double distance_m = 0.0;
  // The unit normal from A to B.
  Vec3 normal_W = Vec3::UnitY();
  // A point of each hull; they are `distance_m` apart along the normal.
  Vec3 on_a_W = Vec3::Zero();
  Vec3 on_b_W = Vec3::Zero();
};

// Returns the separation of two hulls, for distances by the algorithm of Gilbert, Johnson and
// Keerthi (IEEE Journal of Robotics and Automation 4, 1988), and for overlaps by the separating
// axes of faces and edges (Gregorius, "The separating axis test between convex polyhedra", GDC
// 2013). Bounded time, no heap.
HullSeparation separation_of(const PlacedHull& a, const PlacedHull& b);

}  // namespace tactus::rendering
