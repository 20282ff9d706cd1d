// Three prismatic joints along x, y and z: the joint positions are the tool's position.
#pragma once

#include <array>

#include "firmware/kinematics/pose.h"

namespace tactus::firmware {

struct CartesianGeometry {
  std::array<double, 3> carried_kg{};  // mass that moves with each axis, with the axes it carries
};

inline Pose cartesian_forward(const Vec3& joints) {
  return {joints, Mat3::Identity(), kPoseGood};
}

inline bool has_weight(const CartesianGeometry& g) {
  return g.carried_kg != std::array<double, 3>{};
}

// Returns the efforts that hold the axes, N. `gravity_D` is in m/s^2.
inline Vec3 cartesian_gravity_effort(const CartesianGeometry& g, const Vec3& gravity_D) {
  const Vec3 carried_kg(g.carried_kg[0], g.carried_kg[1], g.carried_kg[2]);
  return -carried_kg.cwiseProduct(gravity_D);
}

}  // namespace tactus::firmware
