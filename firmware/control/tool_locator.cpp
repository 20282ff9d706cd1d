#include "firmware/control/tool_locator.h"

#include "firmware/safety/faults.h"

namespace tactus::firmware {

void ToolLocator::configure(const ControllerConfig& config) {
  mechanism = Mechanism(config.mechanism);
  velocity_filter.configure(config.velocity_cutoff_hz, config.rate_hz);
  origin_D = config.workspace_origin_D;
  pose = Pose{};
  tool = rendering::ToolState{};
}

Location ToolLocator::locate(const drivers::JointSample& sample) {
  rest();
  pose = mechanism.forward(joints_of(sample.position), pose.p_D);
  std::uint64_t faults =
      ((pose.status & kPoseNotConverged) != 0 ? kFaultKinematicsNotConverged : kNoFault) |
      ((pose.status & kPoseSingular) != 0 ? kFaultKinematicsSingular : kNoFault);
  const Vec3 velocity = velocity_filter.filter(tool_velocity(pose, joints_of(sample.velocity)));
  if (!pose.p_D.allFinite() || !velocity.allFinite()) {
    pose = Pose{};
    velocity_filter.reset();
    return {.faults = faults | kFaultToolNotFinite};
  }
  tool.p_W = pose.p_D - origin_D;
  tool.v_W = velocity;
  return {.faults = faults, .is_finite = true};
}

}  // namespace tactus::firmware
