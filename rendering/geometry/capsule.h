// A capsule: all points within a radius of a segment. A segment of length 0 makes it a ball. It is
// the region in which the candidate set is valid (rendering/contact/candidate_set.h).
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The default is an empty capsule, in which no point lies.
struct Capsule {
  Vec3 start = Vec3::Zero();  // m
  // The vector from the start to the other end, m.
  Vec3 axis = Vec3::Zero();
  // The radius, m; a capsule with a negative one is empty.
  double radius = -1.0;

  // Returns how deep p lies in the capsule, m; negative outside.
  [[nodiscard]] double depth(const Vec3& p) const;

  // Returns how far a ray from p, which lies inside, along the unit `direction` stays inside, m.
  [[nodiscard]] double room_along(const Vec3& p, const Vec3& direction) const;
};

}  // namespace tactus::rendering
