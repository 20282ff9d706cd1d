// A box in the world frame that the tool shall not leave. Its walls push back as springs with
// dampers that never pull: F = max(K depth - B v, 0) inward, where v is the velocity inward. A tool
// deeper than workspace_overrun_m is a kFaultWorkspace. The certificate limits the walls together
// with the scene. One thread; real time.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/scene_part.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// Returns the walls as the certificate sees them, together with the parts that push at the same
// place.
FeltWalls felt_walls(const SafetyConfig& safety);

// The walls of one workspace.
class WorkspaceWalls {
 public:
  // Takes over the box and the walls' stiffness and damping. Call before the first tick.
  void configure(const ControllerConfig& config);

  // Returns FaultBits: kLimitWorkspace in a wall, kFaultWorkspace beyond it. The position must be
  // finite.
  [[nodiscard]] std::uint64_t check(const Vec3& p_W) const;

  // Returns the force on the hand, N.
  [[nodiscard]] Vec3 push_W(const rendering::ToolState& tool) const;

 private:
  // The corners of the box, m.
  Vec3 lower_W_ = Vec3::Zero();
  Vec3 upper_W_ = Vec3::Zero();
  double stiffness_N_per_m_ = 0.0;
  double damping_Ns_per_m_ = 0.0;
  double overrun_m_ = 0.0;
};

}  // namespace tactus::firmware
