// What forward kinematics gives, and the two linear maps between joints and tool.
//
// Frame D is the device's own: right-handed, x right, y up, z toward the user, origin where the
// mechanism's geometry puts it. Revolute joints are in rad, rad/s, N m; prismatic ones in m, m/s,
// N.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::firmware {

enum PoseStatus : std::uint8_t {
  kPoseGood = 0,
  kPoseNotConverged =
      1U << 0,  // no tool position fits these joints, or none was found: p_D is the seed
  kPoseSingular =
      1U << 1,  // p_D is right, but a force there would need unbounded torques or moves no motor
};

struct Pose {
  Vec3 p_D = Vec3::Zero();  // tool, m
  // d p_D / d joint; zero unless the status is good. The columns of joints that the mechanism does
  // not have are zero.
  Mat3 jacobian_D = Mat3::Zero();
  std::uint8_t status = kPoseGood;
};

// Tool velocity, m/s, from joint velocities.
inline Vec3 tool_velocity(const Pose& pose, const Vec3& joint_velocity) {
  return pose.jacobian_D * joint_velocity;
}

// Joint efforts that put the force (N, on the hand) at the tool: J^T f, by virtual work. With fewer
// than three joints the tool moves on a plane or an arc; what of the force is across that has none.
inline Vec3 joint_effort(const Pose& pose, const Vec3& force_D) {
  return pose.jacobian_D.transpose() * force_D;
}

// The force at the tool (N) that the efforts of a mechanism with that many joints put on the hand,
// along what the tool can move on. Not finite unless the pose is good.
Vec3 tool_force(const Pose& pose, const Vec3& effort, std::size_t joint_count);

}  // namespace tactus::firmware
