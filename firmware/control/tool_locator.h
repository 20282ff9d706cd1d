// Locates the tool: from joint positions and velocities to the tool in the device frame D and the
// world frame W. One thread; real time.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/velocity_filter.h"
#include "firmware/kinematics/mechanism.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// Returns the first three entries: the controller's kJointCount joints.
inline Vec3 joints_of(const std::array<double, drivers::kMaxJoints>& values) {
  return {values[0], values[1], values[2]};
}

// The result of a search for the tool.
struct Location {
  // FaultBits.
  std::uint64_t faults = 0;
  // False if the tool's place is not a number. The tool then stays where it was, at rest.
  bool is_finite = false;
};

// The tool of one mechanism. The members are public because the stages of a tick read them, and
// because the state saves them in the order of its format.
struct ToolLocator {
  // Takes the mechanism, the low-pass and the world's origin; the tool starts at the origin.
  void configure(const ControllerConfig& config);

  // Sets the tool's velocity to 0 for a tick in which it is not located.
  void rest() { tool.v_W.setZero(); }

  // Computes pose and tool from a sample with finite joints.
  Location locate(const drivers::JointSample& sample);

  Mechanism mechanism;
  // The low-pass of the tool's velocity.
  VelocityFilter velocity_filter;
  // The world's origin, m.
  Vec3 origin_D = Vec3::Zero();
  // The pose of the last tick, which is also the seed of the next one's kinematics.
  Pose pose;
  // The tool in the world frame: position, m, and filtered velocity, m/s.
  rendering::ToolState tool;
};

}  // namespace tactus::firmware
