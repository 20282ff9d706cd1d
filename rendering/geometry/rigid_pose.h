// The pose of a body's frame O in the frame W: X_WO takes coordinates in O to coordinates in W.
#pragma once

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// A rotation and a translation: p_W = rotation p_O + translation. The default leaves a point where
// it is.
struct RigidPose {
  Mat3 rotation = Mat3::Identity();  // orthonormal, right-handed
  Vec3 translation = Vec3::Zero();   // m

  // Return a point and a direction of the frame O in the frame W.
  [[nodiscard]] Vec3 point(const Vec3& p_O) const { return rotation * p_O + translation; }
  [[nodiscard]] Vec3 direction(const Vec3& d_O) const { return rotation * d_O; }
  // Return a point and a direction of the frame W in the frame O.
  [[nodiscard]] Vec3 point_in(const Vec3& p_W) const {
    return rotation.transpose() * (p_W - translation);
  }
  [[nodiscard]] Vec3 direction_in(const Vec3& d_W) const { return rotation.transpose() * d_W; }
};

}  // namespace tactus::rendering
