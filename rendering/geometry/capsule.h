// A capsule: all points within a radius of a segment. A segment of length 0 makes it a ball.
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

struct Capsule {
  Vec3 start = Vec3::Zero();  // m
  Vec3 axis = Vec3::Zero();   // from start to the other end, m
  double radius = -1.0;       // m; negative: empty

  // Returns how deep p lies in the capsule, m; negative outside.
  [[nodiscard]] double depth(const Vec3& p) const;

  // Returns how far a ray from p, which lies inside, along the unit `direction` stays inside, m.
  [[nodiscard]] double room_along(const Vec3& p, const Vec3& direction) const;
};

}  // namespace tactus::rendering
