#include "firmware/safety/workspace_walls.h"

#include <algorithm>

#include "firmware/safety/faults.h"

namespace tactus::firmware {

FeltWalls felt_walls(const SafetyConfig& safety) {
  // A test that switches the fault off can push the tool to any depth.
  const bool ends_in_fault = (safety.guards_off & kFaultWorkspace) == 0;
  return {.lower_W = safety.workspace_lower_W,
          .upper_W = safety.workspace_upper_W,
          .stiffness_N_per_m = safety.workspace_stiffness_N_per_m,
          .damping_Ns_per_m = safety.workspace_damping_Ns_per_m,
          .reach_m = ends_in_fault ? safety.workspace_overrun_m : kBoundless_m};
}

void WorkspaceWalls::configure(const ControllerConfig& config) {
  const SafetyConfig& safety = config.safety;
  lower_W_ = safety.workspace_lower_W;
  upper_W_ = safety.workspace_upper_W;
  stiffness_N_per_m_ = safety.workspace_stiffness_N_per_m;
  damping_Ns_per_m_ = safety.workspace_damping_Ns_per_m;
  overrun_m_ = safety.workspace_overrun_m;
}

std::uint64_t WorkspaceWalls::check(const Vec3& p_W) const {
  const double depth = std::max((lower_W_ - p_W).maxCoeff(), (p_W - upper_W_).maxCoeff());
  return (depth > 0.0 ? kLimitWorkspace : kNoFault) |
         (depth > overrun_m_ ? kFaultWorkspace : kNoFault);
}

Vec3 WorkspaceWalls::push_W(const rendering::ToolState& tool) const {
  Vec3 force = Vec3::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double below = lower_W_[axis] - tool.p_W[axis];
    const double above = tool.p_W[axis] - upper_W_[axis];
    const double damping = damping_Ns_per_m_ * tool.v_W[axis];
    if (below > 0.0) {
      force[axis] = std::max(0.0, stiffness_N_per_m_ * below - damping);
    } else if (above > 0.0) {
      force[axis] = std::min(0.0, -stiffness_N_per_m_ * above - damping);
    }
  }
  return force;
}

}  // namespace tactus::firmware
