// The vector types of the house. Arithmetic is in double (Vec3); what is stored in quantity is in
// float (Float3).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tactus {

// A point, direction, velocity or force: metres, 1, m/s or N; the frame is the name's subscript.
using Vec3 = Eigen::Vector3d;
// A rotation, or another linear map of Vec3.
using Mat3 = Eigen::Matrix3d;

namespace rendering {

// A stored vertex, 12 bytes, the layout of the baked image.
struct Float3 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  bool operator==(const Float3&) const = default;
};
static_assert(sizeof(Float3) == 12);

// Returns a stored vertex in double precision, exactly.
inline Vec3 to_vec3(const Float3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Returns the vector rounded to the nearest floats.
inline Float3 to_float3(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace rendering
}  // namespace tactus
