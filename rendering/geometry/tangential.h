// The part of a vector in a plane, and the line that two planes have in common.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns the part of v along the plane whose unit normal is `normal`.
inline Vec3 tangential(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

// Returns the direction of the line that is in both planes, unit; zero if their unit normals are
// nearly parallel.
inline Vec3 crease_between(const Vec3& n0, const Vec3& n1) {
  constexpr double kLeastSquaredSine = 1e-6;
  const Vec3 along = n0.cross(n1);
  const double squared = along.squaredNorm();
  return squared > kLeastSquaredSine ? Vec3{along / std::sqrt(squared)} : Vec3{Vec3::Zero()};
}

}  // namespace tactus::rendering
