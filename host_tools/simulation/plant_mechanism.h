// The simulated device's geometry: how motions of the handle turn the joints. Written from the fact
// sheet's closed form (a position gives its joints), on purpose not the controller's kinematics, so
// that an error in either shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::host {

inline constexpr std::size_t kPlantJoints = 3;

// Base frame B: x right, y up, z from the base toward the user.
enum class MechanismKind : std::uint8_t {
  cartesian,         // three prismatic joints along the base's axes: joint = handle position
  falcon_delta,      // Novint Falcon: three revolute shoulders of a delta
  hapkit,            // one paddle about z: the handle moves on an arc, straight up at 0
  haply_pantograph,  // five-bar linkage of two motors, flat in the plane y = 0
  phantom_premium,   // serial arm: azimuth, upper arm from level, forearm from hanging
  woodenhaptics,     // the same with other lengths
};

// Joints that the mechanism has; the further ones read 0 and move nothing.
std::size_t joints_of(MechanismKind kind);

// Row i: how fast joint i turns per m/s of the handle. Joint speeds are rows . v; by virtual work
// the handle feels sum_i row_i effort_i.
using JointRateRows = std::array<Vec3, kPlantJoints>;

struct MechanismPose {
  JointRateRows rows{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  // tan(half the joint's angle, from where the mechanism's file has its middle), the position
  // itself (m) for Cartesian; `joint_position` reads it.
  std::array<double, kPlantJoints> coordinate{};
  bool reachable = true;  // false where the links do not reach; the rows then stay finite
};

// No transcendental functions: it runs at every sub-step.
void solve_mechanism(MechanismKind kind, const Vec3& p_B, MechanismPose& pose);

// rad, m for Cartesian; of joint 0, 1 or 2.
double joint_position(MechanismKind kind, std::size_t joint, double coordinate);

// With fewer than three joints the handle can only move on an arc or a plane: the nearest point of
// it, and what of a velocity or a force is along it there.
Vec3 on_manifold(MechanismKind kind, const Vec3& p_B);
Vec3 along_manifold(MechanismKind kind, const Vec3& p_B, const Vec3& v_B);

// Of a mass of 1 kg at every elbow (the joint between the base's link and the tool's; none for
// Cartesian and the paddle): the sum of the elbows' positions, and the force on the handle that
// gravity (m/s^2) pulls on them with.
Vec3 elbow_sum(MechanismKind kind, const MechanismPose& pose);
Vec3 elbow_pull(MechanismKind kind, const MechanismPose& pose, const Vec3& gravity_B);

}  // namespace tactus::host
