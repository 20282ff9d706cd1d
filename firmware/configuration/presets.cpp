// The configurations of known mechanisms. The figures are published for the device unless a comment
// calls them assumed.

#include "firmware/configuration/controller_config.h"
#include "hal/angle.h"

namespace tactus::firmware {
namespace {

using hal::radians_of;

}  // namespace

ControllerConfig cartesian_config() {
  return {};
}

ControllerConfig falcon_config() {
  ControllerConfig config;
  const DeltaGeometry geometry;
  config.mechanism = geometry;
  config.workspace_origin_D = {0.0, 0.0, geometry.nominal_height_m};
  // The range contains every pose within 50 mm of the workspace's middle (-43 to 75 degrees). 8 N
  // need 0.67 N m at the worst place and direction within 40 mm of it; the Falcon's true limit is
  // not published.
  config.joints.fill({.lower = -0.80, .upper = 1.45, .max_effort = 0.7});
  config.safety.device_delay_s = 0.002;  // assumed: a tick, and its motors' slow amplifiers
  config.safety.max_force_N = 8.0;
  return config;
}

ControllerConfig hapkit_config() {
  // 0.03 N m at full duty on a pulley of 4.191 mm, under a sector of 73.152 mm.
  constexpr double kSectorTorque_Nm = 0.03 * 0.073152 / 0.004191;
  ControllerConfig config;
  const PaddleGeometry geometry;
  config.mechanism = geometry;
  config.workspace_origin_D = {0.0, geometry.handle_radius_m, 0.0};
  // The sectors of Hapkits span about 90 degrees.
  config.joints[0] = {
      .lower = radians_of(-45.0), .upper = radians_of(45.0), .max_effort = kSectorTorque_Nm};
  config.safety.max_force_N = 7.9;  // of the 7.98 N that the motor gives
  return config;
}

ControllerConfig haply_pantograph_config() {
  ControllerConfig config;
  config.mechanism = PantographGeometry{};
  config.workspace_origin_D = {0.01, 0.0, 0.075};
  // The range goes from the home pose (180 and 0 degrees) inward. It is assumed: the stops are not
  // published.
  config.joints[0] = {.lower = radians_of(80.0), .upper = radians_of(185.0), .max_effort = 0.123};
  config.joints[1] = {.lower = radians_of(-5.0), .upper = radians_of(100.0), .max_effort = 0.123};
  // The force that the motors give in the worst direction.
  config.safety.max_force_N = 2.4;
  return config;
}

ControllerConfig phantom_premium_config() {
  // Maxon RE 25 118743: 28.6 mN m continuous (129 at stall), times the capstans' ratios.
  constexpr double kNominal_Nm = 0.0286;
  ControllerConfig config;
  const SerialArmGeometry geometry;
  config.mechanism = geometry;
  config.workspace_origin_D = {0.0, -geometry.forearm_m, geometry.upper_m};
  config.joints = {
      {{.lower = radians_of(-90.0), .upper = radians_of(90.0), .max_effort = 13.3 * kNominal_Nm},
       {.lower = radians_of(-124.0), .upper = radians_of(119.0), .max_effort = 11.2 * kNominal_Nm},
       {.lower = radians_of(-29.0), .upper = radians_of(214.0), .max_effort = 11.2 * kNominal_Nm}}};
  config.coupled_limits[0] = {
      .joint = 1, .minus = 2, .lower = radians_of(-55.0), .upper = radians_of(65.0)};
  config.safety.max_force_N = 8.5;
  return config;
}

ControllerConfig woodenhaptics_config() {
  // Maxon with 0.0259 N m/A on amplifiers of 6 A.
  constexpr double kMotor_Nm = 0.0259 * 6.0;
  constexpr double kFirstRatio = 16.0;
  constexpr double kRatio = 12.0;
  ControllerConfig config;
  config.mechanism = SerialArmGeometry{.upper_m = 0.205,
                                       .forearm_m = 0.245,
                                       .shoulder_height_m = 0.080,
                                       .upper = {.mass_kg = 0.17, .centre_m = 0.051},
                                       .forearm = {.mass_kg = 0.11, .centre_m = 0.091}};
  config.workspace_origin_D = {0.0, 0.080, 0.220};
  // These are assumed: the stops are not published.
  config.joints = {
      {{.lower = radians_of(-70.0),
        .upper = radians_of(70.0),
        .max_effort = kFirstRatio * kMotor_Nm},
       {.lower = radians_of(-20.0), .upper = radians_of(135.0), .max_effort = kRatio * kMotor_Nm},
       {.lower = radians_of(-20.0), .upper = radians_of(140.0), .max_effort = kRatio * kMotor_Nm}}};
  config.coupled_limits[0] = {
      .joint = 1, .minus = 2, .lower = radians_of(-70.0), .upper = radians_of(70.0)};
  config.safety.max_force_N = 5.0;
  return config;
}

std::optional<ControllerConfig> preset_config(std::string_view name) {
  for (const Preset& preset : kPresets) {
    if (preset.name == name) {
      return preset.config();
    }
  }
  return std::nullopt;
}

}  // namespace tactus::firmware
