// The operations of the friction models on a tangential vector, for one dimension and for the
// tangent plane.
#pragma once

#include <cmath>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

template <typename Vector>
Vector zero_tangent();

template <>
inline double zero_tangent<double>() {
  return 0.0;
}

template <>
inline Vec3 zero_tangent<Vec3>() {
  return Vec3::Zero();
}

inline double dot(double a, double b) {
  return a * b;
}

inline double dot(const Vec3& a, const Vec3& b) {
  return a.dot(b);
}

inline double length(double v) {
  return std::fabs(v);
}

inline double length(const Vec3& v) {
  return v.norm();
}

}  // namespace tactus::rendering
