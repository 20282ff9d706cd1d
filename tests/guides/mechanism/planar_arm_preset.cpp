// The figures are assumed.
#include <numbers>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

ControllerConfig planar_arm_config() {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kMotor_Nm = 0.12;
  ControllerConfig config;
  const PlanarArmGeometry geometry;
  config.mechanism = geometry;
  config.workspace_origin_D = {geometry.inner_m, 0.0, geometry.outer_m};
  config.joints[0] = {.lower = -60.0 * kDegree, .upper = 60.0 * kDegree, .max_effort = kMotor_Nm};
  config.joints[1] = {.lower = 30.0 * kDegree, .upper = 150.0 * kDegree, .max_effort = kMotor_Nm};
  config.safety.max_force_N = 1.0;
  return config;
}

}  // namespace tactus::firmware
