// Three prismatic joints along x, y and z: the joints are the tool's position.
#pragma once

#include "firmware/kinematics/pose.h"

namespace tactus::firmware {

struct CartesianGeometry {};

inline Pose cartesian_forward(const Vec3& joints) {
  return {joints, Mat3::Identity(), kPoseGood};
}

}  // namespace tactus::firmware
