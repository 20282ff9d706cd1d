// The geometry of the simulated devices: how motions of the handle turn the joints. It is derived
// from the published closed forms, position to joints, and on purpose shares nothing with the
// controller's kinematics (firmware/kinematics), so that an error in either shows in the whole-loop
// tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// The largest number of joints of a mechanism.
inline constexpr std::size_t kPlantJoints = 3;

// The mechanisms. All use the base frame B: x right, y up, z from the base toward the user.
enum class MechanismKind : std::uint8_t {
  // Three linear joints along the axes of B; a joint's position is the handle's coordinate.
  cartesian,
  // Novint Falcon: a delta with three revolute shoulders.
  falcon_delta,
  // One paddle about z: the handle moves on an arc and is straight up at 0.
  hapkit,
  // A five-bar linkage of two motors, flat in the plane y = 0.
  haply_pantograph,
  // A serial arm: azimuth, upper arm from level, forearm from hanging.
  phantom_premium,
  // The same arm with other lengths and a raised shoulder.
  woodenhaptics,
};

// Returns the number of joints that the mechanism has; joints beyond it read 0 and move nothing.
std::size_t joints_of(MechanismKind kind);

// Row i is the rate of joint i (rad/s or m/s) for each m/s of the handle: joint rates = rows . v.
// By virtual work, the handle feels the force sum_i row_i effort_i.
using JointRateRows = std::array<Vec3, kPlantJoints>;

// The joints at one position of the handle.
struct MechanismPose {
  JointRateRows rows{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  // tan(half the joint's angle), counted from the middle of its travel; for `cartesian` the
  // position itself, m. joint_position() turns it into rad or m.
  std::array<double, kPlantJoints> coordinate{};
  // False where the links do not reach; the rows are finite even then.
  bool reachable = true;
};

// Computes the pose for a handle at `p_B`, m. It uses no transcendental functions, since it runs in
// every sub-step and must give the same bits on every processor.
void solve_mechanism(MechanismKind kind, const Vec3& p_B, MechanismPose& pose);

// Returns the position of joint 0, 1 or 2 that belongs to a coordinate, rad, or m for `cartesian`.
double joint_position(MechanismKind kind, std::size_t joint, double coordinate);

// With fewer than three joints the handle moves only on an arc or a plane, the manifold. Returns
// the point of it that is nearest to `p_B`, m.
Vec3 on_manifold(MechanismKind kind, const Vec3& p_B);
// Returns the part of a velocity or force at `p_B` that is tangent to the manifold.
Vec3 along_manifold(MechanismKind kind, const Vec3& p_B, const Vec3& v_B);

// The elbow is the joint between the link at the base and the link at the handle; `cartesian` and
// `hapkit` have none. Returns the sum of the elbows' positions, m.
Vec3 elbow_sum(MechanismKind kind, const MechanismPose& pose);
// Returns the force on the handle, N, from gravity (m/s^2) on a mass of 1 kg at every elbow.
Vec3 elbow_pull(MechanismKind kind, const MechanismPose& pose, const Vec3& gravity_B);

}  // namespace tactus::host
