#include "host_tools/simulation/device_presets.h"

#include <numbers>

namespace tactus::host {

DevicePreset cartesian_preset() {
  DevicePreset preset;
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = MechanismKind::cartesian;
  plant.moving_mass_kg = 0.1;
  plant.viscous_Ns_per_m = 0.5;
  // A back-drive friction between those of the PHANToM Premium (0.04 N) and Desktop (0.06 N). The
  // bristles stand for the transmission's give; their damping stays below what the viscous damping
  // keeps passive.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.04,
                          .static_level = 0.05,
                          .stribeck_velocity_m_per_s = 0.005,
                          .stiffness_N_per_m = 2000.0,
                          .damping_s_per_m = 1.5};
  plant.stop_lower_B = Vec3::Constant(-0.12);
  plant.stop_upper_B = Vec3::Constant(0.12);
  preset.device.encoder_resolution = 5e-6;
  preset.device.effort_limit = 12.0;
  preset.device.motor_time_constant_s = 0.5e-3;
  return preset;
}

DevicePreset falcon_preset() {
  constexpr double kCountsPerTurn = 1280.0;
  constexpr double kMotorTurnsPerArmTurn = 110.0 / 14.25;
  DevicePreset preset;
  preset.centre_B = Vec3(0.0, 0.0, 0.12);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = MechanismKind::falcon_delta;
  plant.moving_mass_kg = 0.25;
  plant.viscous_Ns_per_m = 0.5;
  // 0.006 N m on a 60 mm arm is 0.1 N at the knee.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.006,
                          .static_level = 0.0075,
                          .stribeck_velocity_m_per_s = 0.1,
                          .stiffness_N_per_m = 5.0,
                          .damping_s_per_m = 0.005};
  plant.stop_lower_B = preset.centre_B - Vec3(0.05, 0.05, 0.045);
  plant.stop_upper_B = preset.centre_B + Vec3(0.05, 0.05, 0.045);
  preset.device.encoder_resolution =
      2.0 * std::numbers::pi / (kCountsPerTurn * kMotorTurnsPerArmTurn);
  preset.device.effort_limit = 0.45;  // 8.9 N at the lever of the workspace's middle, 0.05 m
  preset.device.motor_time_constant_s = 1e-3;
  return preset;
}

std::optional<DevicePreset> device_preset(std::string_view name) {
  if (name == "cartesian") {
    return cartesian_preset();
  }
  if (name == "falcon") {
    return falcon_preset();
  }
  return std::nullopt;
}

}  // namespace tactus::host
