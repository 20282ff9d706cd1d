// Convex hulls: the collision shapes of bodies, and of what they meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A polygon of a hull, counter-clockwise from outside: `count` numbers from `first` on in
// ConvexHull::corners.
struct HullFace {
  Vec3 normal_O = Vec3::UnitX();  // unit, outward
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// An edge of a hull. Seen from outside, with `to` above `from`, one face lies to its left and one
// to its right.
struct HullEdge {
  std::uint16_t from = 0;
  std::uint16_t to = 0;
  std::uint16_t left = 0;
  std::uint16_t right = 0;
};

// Two circles about one axis that bound a round solid: a cylinder, or a cone whose tip is a circle
// without radius. The hull of vertices is then a polyhedron near it.
struct HullCircles {
  Vec3 axis_O = Vec3::UnitY();  // unit, from the first circle to the second
  std::array<Vec3, 2> centers_O{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> radii_m{};
};

// A convex solid: all points within `radius_m` of the hull of its vertices. A sphere is a vertex
// with a radius, a capsule an edge with a radius; both have no faces. Views of memory that the
// caller keeps alive and unchanged.
struct ConvexHull {
  std::span<const Vec3> vertices_O;
  std::span<const HullFace> faces;
  std::span<const std::uint8_t> corners;
  std::span<const HullEdge> edges;
  double radius_m = 0.0;
  // The circles of a round solid, by which it rolls over planes and triangles; nullptr for another.
  const HullCircles* circles = nullptr;
};

}  // namespace tactus::rendering
