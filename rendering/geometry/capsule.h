// All points within a radius of a straight way; of one point, where the way is zero.
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

struct Capsule {
  Vec3 start = Vec3::Zero();  // m
  Vec3 axis = Vec3::Zero();   // from start to the other end, m
  double radius = -1.0;       // m; negative: empty

  // How deep p lies in it; negative outside.
  [[nodiscard]] double depth(const Vec3& p) const;

  // How far from p, which lies in it, a straight line along the unit `direction` stays in it.
  [[nodiscard]] double room_along(const Vec3& p, const Vec3& direction) const;
};

}  // namespace tactus::rendering
