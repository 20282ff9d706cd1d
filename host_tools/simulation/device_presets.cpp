#include "host_tools/simulation/device_presets.h"

#include <numbers>

#include "hal/angle.h"
#include "host_tools/simulation/plant_lengths.h"

namespace tactus::host {

DevicePreset cartesian_preset() {
  DevicePreset preset;
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = CartesianAxes{};
  plant.moving_mass_kg = 0.1;
  plant.viscous_Ns_per_m = 0.5;
  // The Coulomb level is the back-drive friction of a light desktop arm: the PHANToM Premium has
  // 0.04 N, the Desktop 0.06 N. The bristles' stiffness stands for the compliance of the
  // transmission. Their damping stays below the value up to which the viscous damping keeps the
  // joint passive.
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
  // Counts of the encoder on the motor, and the capstan's ratio of diameters.
  constexpr double kCountsPerTurn = 1280.0;
  constexpr double kMotorTurnsPerArmTurn = 110.0 / 14.25;
  DevicePreset preset;
  preset.centre_B = Vec3(0.0, 0.0, 0.12);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = DeltaLengths{};
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

DevicePreset hapkit_preset() {
  // Radii of the motor's pulley and of the paddle's sector, which it drives by friction.
  constexpr double kPulley_m = 0.004191;
  constexpr double kSector_m = 0.073152;
  DevicePreset preset;
  preset.centre_B = Vec3(0.0, PaddleLengths{}.radius_m, 0.0);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = PaddleLengths{};
  plant.moving_mass_kg = 0.08;
  plant.viscous_Ns_per_m = 0.3;
  // 0.1 N at the handle.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.0065,
                          .static_level = 0.008,
                          .stribeck_velocity_m_per_s = 0.1,
                          .stiffness_N_per_m = 5.0,
                          .damping_s_per_m = 0.004};
  // 38 degrees to either side; the arc is 14 mm lower there.
  plant.stop_lower_B = preset.centre_B - Vec3(0.04, 0.02, 0.0);
  plant.stop_upper_B = preset.centre_B + Vec3(0.04, 0.0, 0.0);
  // A step of the magnetic sensor on the motor's shaft.
  preset.device.encoder_resolution = hal::radians_of(0.0107);
  // 0.03 N m of the motor through the ratio of the radii.
  preset.device.effort_limit = 0.03 * kSector_m / kPulley_m;
  preset.device.motor_time_constant_s = 0.5e-3;
  return preset;
}

DevicePreset haply_pantograph_preset() {
  constexpr double kCountsPerTurn = 13824.0;
  DevicePreset preset;
  preset.centre_B = Vec3(0.01, 0.0, 0.075);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = PantographLengths{};
  plant.moving_mass_kg = 0.06;
  plant.viscous_Ns_per_m = 0.3;
  // 0.05 N at the handle.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.002,
                          .static_level = 0.0025,
                          .stribeck_velocity_m_per_s = 0.1,
                          .stiffness_N_per_m = 2.0,
                          .damping_s_per_m = 0.001};
  plant.stop_lower_B = preset.centre_B - Vec3(0.03, 0.0, 0.03);
  plant.stop_upper_B = preset.centre_B + Vec3(0.03, 0.0, 0.03);
  preset.device.encoder_resolution = 2.0 * std::numbers::pi / kCountsPerTurn;
  preset.device.effort_limit = 0.123;
  preset.device.motor_time_constant_s = 0.5e-3;
  return preset;
}

DevicePreset phantom_premium_preset() {
  // The first joint has a ratio of 13.3; the model gives it 11.2 like the others, so it is a little
  // coarser and weaker than in the real device.
  constexpr double kCountsPerTurn = 4096.0;
  constexpr double kRatio = 11.2;
  constexpr double kStall_Nm = 0.129;
  DevicePreset preset;
  preset.centre_B = Vec3(0.0, -0.11, 0.21);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = kPhantomLengths;
  plant.moving_mass_kg = 0.075;
  plant.viscous_Ns_per_m = 0.5;
  // The back-drive friction of 0.04 N on a lever of 0.2 m.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.008,
                          .static_level = 0.01,
                          .stribeck_velocity_m_per_s = 0.025,
                          .stiffness_N_per_m = 80.0,
                          .damping_s_per_m = 0.02};
  plant.stop_lower_B = preset.centre_B - Vec3::Constant(0.075);
  plant.stop_upper_B = preset.centre_B + Vec3::Constant(0.075);
  preset.device.encoder_resolution = 2.0 * std::numbers::pi / (kCountsPerTurn * kRatio);
  preset.device.effort_limit = kStall_Nm * kRatio;
  preset.device.motor_time_constant_s = 0.5e-3;
  return preset;
}

DevicePreset woodenhaptics_preset() {
  // The first joint has a ratio of 16; the model gives it 12 like the others.
  constexpr double kCountsPerTurn = 2000.0;
  constexpr double kRatio = 12.0;
  constexpr double kMotor_Nm = 0.0259 * 6.0;
  DevicePreset preset;
  preset.centre_B = Vec3(0.0, 0.08, 0.22);
  PlantParameters& plant = preset.device.plant;
  plant.mechanism = kWoodenLengths;
  plant.moving_mass_kg = 0.25;
  plant.viscous_Ns_per_m = 0.6;
  // 0.1 N on a lever of 0.22 m.
  plant.joint_friction = {.kind = rendering::FrictionKind::lugre,
                          .coulomb = 0.022,
                          .static_level = 0.027,
                          .stribeck_velocity_m_per_s = 0.025,
                          .stiffness_N_per_m = 150.0,
                          .damping_s_per_m = 0.04};
  plant.stop_lower_B = preset.centre_B - Vec3::Constant(0.1);
  plant.stop_upper_B = preset.centre_B + Vec3::Constant(0.1);
  // A link's mass is divided over its two ends so that the centre of mass stays in place. Upper
  // arm: 0.17 kg, its centre at 51 of 205 mm; forearm: 0.11 kg, at 91 of 245 mm.
  constexpr double kUpperShare = 0.051 / 0.205;
  constexpr double kForearmShare = 0.091 / 0.245;
  plant.elbow_kg = 0.17 * kUpperShare + 0.11 * (1.0 - kForearmShare);
  plant.handle_kg = 0.11 * kForearmShare;
  preset.device.encoder_resolution = 2.0 * std::numbers::pi / (kCountsPerTurn * kRatio);
  preset.device.effort_limit = kMotor_Nm * kRatio;
  preset.device.motor_time_constant_s = 0.5e-3;
  return preset;
}

std::optional<DevicePreset> device_preset(std::string_view name) {
  if (name == "cartesian") {
    return cartesian_preset();
  }
  if (name == "falcon") {
    return falcon_preset();
  }
  if (name == "hapkit") {
    return hapkit_preset();
  }
  if (name == "haply_pantograph") {
    return haply_pantograph_preset();
  }
  if (name == "phantom_premium") {
    return phantom_premium_preset();
  }
  if (name == "woodenhaptics") {
    return woodenhaptics_preset();
  }
  return std::nullopt;
}

}  // namespace tactus::host
