// The mobility of the joints with a mass at the tool (the diagonal of the inverse of the
// joint-space inertia m J^T J). Pure function for any thread; real time.
#pragma once

#include <cstddef>

#include "firmware/kinematics/pose.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// Returns the diagonal of (m J^T J)^-1: the acceleration of each of the first `joint_count` joints
// for one unit of its own effort while the other joints are free, in rad/s^2 per N m or m/s^2 per
// N. Not finite in a singular pose.
inline Vec3 joint_mobility(const Pose& pose, std::size_t joint_count, double mass_kg) {
  Mat3 inertia = mass_kg * pose.jacobian_D.transpose() * pose.jacobian_D;
  for (auto i = static_cast<Eigen::Index>(joint_count); i < inertia.rows(); ++i) {
    inertia(i, i) = 1.0;  // a joint that the mechanism does not have
  }
  return inertia.inverse().diagonal();
}

}  // namespace tactus::firmware
