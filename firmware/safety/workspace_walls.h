// A box in the world frame that the tool shall not leave. Its walls push back like springs with
// dampers, which never pull: F = max(K depth - B v, 0) inward, v the velocity inward. Deeper than
// workspace_overrun_m: kFaultWorkspace. The certificate binds them together with the scene.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/scene_part.h"
#include "rendering/geometry/vector.h"
#include "rendering/world/touch.h"

namespace tactus::firmware {

// How the walls count against the certificate, with what pushes at the same place.
FeltWalls felt_walls(const SafetyConfig& safety);

class WorkspaceWalls {
 public:
  void configure(const ControllerConfig& config);

  // FaultBits: kLimitWorkspace in a wall, kFaultWorkspace through it. The tool is finite.
  [[nodiscard]] std::uint64_t check(const Vec3& p_W) const;

  // N, on the hand.
  [[nodiscard]] Vec3 push_W(const rendering::ToolState& tool) const;

 private:
  Vec3 lower_W_ = Vec3::Zero();
  Vec3 upper_W_ = Vec3::Zero();
  double stiffness_N_per_m_ = 0.0;
  double damping_Ns_per_m_ = 0.0;
  double overrun_m_ = 0.0;
};

}  // namespace tactus::firmware
