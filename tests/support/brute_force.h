// Slow answers by other ways than the code under test takes: every triangle is asked, and no
// formula is shared.
#pragma once

#include <span>
#include <vector>

#include "tests/support/shapes.h"

namespace tactus::testing {

struct Corners {
  Vec3 a, b, c;
  Vec3 centre;  // of a ball round the triangle
  double radius_m;
};

std::vector<Corners> corners_of(const Shape& shape);

// Nearest point of a triangle to q.
Vec3 nearest_point(const Corners& t, const Vec3& q);

// Smallest distance between the segment p-q and the triangle; 0 where they meet.
double segment_distance(const Corners& t, const Vec3& p, const Vec3& q);

// Smallest distance between the segment and any triangle, if it is below `within`; otherwise
// something not below it.
double clearance(std::span<const Corners> triangles, const Vec3& p, const Vec3& q, double within);

// How far the best direction of descent still leads from p toward h, first order: |projection of h
// - p on the cone of directions u with n . u >= 0 for each normal n|. 0 at a local minimum of |p -
// h|.
double descent_left(const Vec3& p, const Vec3& h, std::span<const Vec3> normals);

// The same, where what comes within `reach` of p holds it.
double descent_left(const Vec3& p, const Vec3& h, std::span<const Corners> triangles, double reach);

}  // namespace tactus::testing
