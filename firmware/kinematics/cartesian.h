// Three prismatic joints along x, y and z of frame D: the joint positions, m, are the tool's
// position. Pure functions for any thread; real time.
#pragma once

#include <array>

#include "firmware/kinematics/pose.h"

namespace tactus::firmware {

// The weights of the three axes.
struct CartesianGeometry {
  // The mass that moves with each axis, kg, together with the axes that it carries.
  std::array<double, 3> carried_kg{};
};

// Returns the pose, which is never singular.
inline Pose cartesian_forward(const Vec3& joints) {
  return {joints, Mat3::Identity(), kPoseGood};
}

// Returns true if a mass is set.
inline bool has_weight(const CartesianGeometry& g) {
  return g.carried_kg != std::array<double, 3>{};
}

// Returns the efforts that hold the axes, N. `gravity_D` is in m/s^2.
inline Vec3 cartesian_gravity_effort(const CartesianGeometry& g, const Vec3& gravity_D) {
  const Vec3 carried_kg(g.carried_kg[0], g.carried_kg[1], g.carried_kg[2]);
  return -carried_kg.cwiseProduct(gravity_D);
}

}  // namespace tactus::firmware
