// The plane of each edge perpendicular to the face tells whether the query point projects inside.
// If it does not, the nearest point lies on an edge whose plane has the point outside, so only
// those edges are measured. Near a border the two answers agree, so a sign that rounding gets wrong
// costs nothing; slivers are as exact as fat triangles, because no barycentric coordinate is
// divided by an area.
#include "rendering/geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::rendering {

Triangle::Triangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : corner_{a, b, c}, edge_{b - a, c - b, a - c} {
  const Vec3 area_vector = edge_[0].cross(-edge_[2]);
  const double length = area_vector.norm();
  if (length > 0.0) {
    normal_ = area_vector * (1.0 / length);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    inward_[k] = normal_.cross(edge_[k]);
  }
}

Nearest Triangle::nearest(const Vec3& q) const {
  const std::array<double, 3> inward = inward_of(q);
  if (is_inside(inward)) {
    const double h = height(q);
    return {.distance = std::abs(h), .normal = h < 0.0 ? Vec3{-normal_} : normal_};
  }
  return nearest_on_border(q, inward);
}

// Only edges that have q outside can hold the nearest point. On each, the share `along` is 0 or 1
// at a corner, so that corners are compared exactly and a vertex is told from an edge without a
// tolerance.
Nearest Triangle::nearest_on_border(const Vec3& q, const std::array<double, 3>& inward) const {
  Nearest best;
  double best_squared = std::numeric_limits<double>::infinity();
  for (std::uint8_t k = 0; k < 3; ++k) {
    if (inward[k] > 0.0) {
      continue;
    }
    const Vec3 from_corner = q - corner_[k];
    const double product = from_corner.dot(edge_[k]);
    const double squared_length = edge_[k].squaredNorm();
    double along = 0.0;
    if (product >= squared_length) {
      along = squared_length > 0.0 ? 1.0 : 0.0;
    } else if (product > 0.0) {
      along = product / squared_length;
    }
    const Vec3 offset = from_corner - along * edge_[k];
    const double squared = offset.squaredNorm();
    if (squared < best_squared) {
      best_squared = squared;
      best.normal = offset;
      best.feature = along > 0.0 && along < 1.0 ? Feature::edge : Feature::vertex;
      best.edge = k;
    }
  }
  best.distance = std::sqrt(best_squared);
  if (best.distance > 0.0) {
    best.normal *= 1.0 / best.distance;
  } else {
    best.normal = normal_;
  }
  return best;
}

}  // namespace tactus::rendering
