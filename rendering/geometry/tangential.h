// The part of a vector in a plane.
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns the part of v along the plane whose unit normal is `normal`.
inline Vec3 tangential(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace tactus::rendering
