// The result of forward kinematics, and the linear maps between joints and tool. Pure functions for
// any thread; real time.
//
// Frame D is the device's own: right-handed, x right, y up, z toward the user, origin where the
// mechanism's geometry puts it. Revolute joints are in rad, rad/s, N m; prismatic ones in m, m/s,
// N.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// The bits of Pose::status.
enum PoseStatus : std::uint8_t {
  kPoseGood = 0,
  // No tool position was found for these joints; p_D is the seed.
  kPoseNotConverged = 1U << 0,
  // The position is right, but a force needs unbounded torques or none at all.
  kPoseSingular = 1U << 1,
};

// The place of the tool for given joints.
struct Pose {
  // The position of the tool, m.
  Vec3 p_D = Vec3::Zero();
  // The derivative of p_D by the joints, m/rad or 1. It is zero unless the status is good; the
  // columns of joints beyond the mechanism's are zero.
  Mat3 jacobian_D = Mat3::Zero();
  // PoseStatus bits.
  std::uint8_t status = kPoseGood;
};

// Returns the tool's velocity, m/s, from the joints' velocities.
inline Vec3 tool_velocity(const Pose& pose, const Vec3& joint_velocity) {
  return pose.jacobian_D * joint_velocity;
}

// Returns the joint efforts J^T f that put the force `force_D` (N, on the hand) at the tool. With
// fewer than three joints the tool moves on a plane or an arc; the part of the force across it
// needs no effort.
inline Vec3 joint_effort(const Pose& pose, const Vec3& force_D) {
  return pose.jacobian_D.transpose() * force_D;
}

// Returns the force, N, that the efforts put on the hand at the tool, in the directions in which
// the tool can move. `joint_count` is the mechanism's number of joints. Not finite unless the pose
// is good.
Vec3 tool_force(const Pose& pose, const Vec3& effort, std::size_t joint_count);

}  // namespace tactus::firmware
