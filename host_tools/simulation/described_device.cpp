#include "host_tools/simulation/described_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "host_tools/input_error.h"
#include "host_tools/simulation/described_mechanism.h"
#include "host_tools/simulation/device_workspace.h"

namespace tactus::host {
namespace {

// The lightest device that the plant simulates.
constexpr double kLeastMass_kg = 0.01;

// Sets encoders, motors and delay to what the file says of them.
void take_electronics(const firmware::DeviceConfig& config, const firmware::ControllerConfig& usual,
                      DeviceParameters& device) {
  const firmware::PlantConfig& given = config.plant;
  double resolution = 0.0;
  double effort = 0.0;
  double usual_effort = 0.0;
  for (std::size_t i = 0; i < config.joint_count; ++i) {
    const firmware::JointConfig& joint = config.joints[i];
    resolution = std::max(resolution, encoder_count_of(config, joint).value_or(0.0));
    effort = std::max(effort, joint.limits.max_effort);
    usual_effort = std::max(usual_effort, usual.joints[i].max_effort);
  }
  if (effort != usual_effort) {
    device.effort_limit = effort;
  }
  device.encoder_resolution =
      given.encoder_resolution.value_or(resolution > 0.0 ? resolution : device.encoder_resolution);
  device.velocity_cutoff_Hz = given.velocity_cutoff_hz.value_or(device.velocity_cutoff_Hz);
  device.motor_time_constant_s = given.motor_time_constant_s.value_or(device.motor_time_constant_s);
  device.delay_ticks = given.delay_ticks.value_or(static_cast<std::uint32_t>(device.delay_ticks));
}

// Friction is scaled so that the bristles' deflection stays the same. Their damping then grows with
// the square root, which keeps the damping ratio.
void take_friction(const firmware::PlantConfig& given, rendering::FrictionParameters& friction) {
  if (!given.coulomb_friction) {
    return;
  }
  const double share = friction.coulomb > 0.0 ? *given.coulomb_friction / friction.coulomb : 0.0;
  friction.coulomb = *given.coulomb_friction;
  friction.static_level = given.breakaway_friction.value_or(*given.coulomb_friction);
  friction.stiffness_N_per_m *= share;
  friction.damping_s_per_m *= std::sqrt(share);
  if (friction.static_level == 0.0) {
    friction = {};
  }
}

// Returns true if the joints' limits are the same.
bool same_limits(const firmware::ControllerConfig& a, const firmware::ControllerConfig& b) {
  return std::ranges::equal(
      a.joints, b.joints, [](const firmware::JointLimits& one, const firmware::JointLimits& other) {
        return one.lower == other.lower && one.upper == other.upper;
      });
}

// Returns the preset's workspace, larger or smaller as the links are.
DeviceWorkspace scaled_workspace(const DevicePreset& preset, const PlantMechanism& mechanism) {
  const PlantParameters& plant = preset.device.plant;
  const double share = whole_length_m(mechanism) / whole_length_m(plant.mechanism);
  Vec3 from_B = Vec3::Zero();
  Vec3 to_B = Vec3::Zero();
  if (const auto* const arm = std::get_if<ArmLengths>(&mechanism)) {
    from_B.y() = std::get<ArmLengths>(plant.mechanism).shoulder_m;
    to_B.y() = arm->shoulder_m;
  }
  const auto moved = [&](const Vec3& p_B) -> Vec3 { return to_B + share * (p_B - from_B); };
  DeviceWorkspace box{.centre_B = moved(preset.centre_B),
                      .lower_B = moved(plant.stop_lower_B),
                      .upper_B = moved(plant.stop_upper_B)};
  if (const auto* const pantograph = std::get_if<PantographLengths>(&mechanism)) {
    const Vec3 to_middle(0.5 * pantograph->base_m - box.centre_B.x(), 0.0, 0.0);
    box = {.centre_B = box.centre_B + to_middle,
           .lower_B = box.lower_B + to_middle,
           .upper_B = box.upper_B + to_middle};
  }
  return box;
}

// Gives the device the file's workspace. Throws InputError if there is none.
void take_workspace(const firmware::DeviceConfig& config, const PlantMechanism& mechanism,
                    DevicePreset& preset) {
  const auto box =
      find_workspace(config.controller, mechanism, scaled_workspace(preset, mechanism));
  if (!box) {
    throw InputError(fmt::format(
        "[mechanism] '{}': with these lengths the handle reaches no place in which every "
        "joint is between its lower_rad and upper_rad; correct the lengths, or write "
        "lower_rad and upper_rad of each [[joint]]",
        config.preset));
  }
  preset.centre_B = box->centre_B;
  preset.device.plant.stop_lower_B = box->lower_B;
  preset.device.plant.stop_upper_B = box->upper_B;
}

// Gives the device the file's weights, and their inertia.
void take_weights(const firmware::ControllerConfig& controller, DevicePreset& preset) {
  PlantParameters& plant = preset.device.plant;
  const PlantWeights weights = plant_weights(controller.mechanism);
  plant.elbow_kg = weights.elbow_kg;
  plant.handle_kg = weights.handle_kg;
  if (firmware::has_weight(controller.mechanism)) {
    MechanismPose pose;
    solve_mechanism(plant.mechanism, on_manifold(plant.mechanism, preset.centre_B), pose);
    plant.moving_mass_kg =
        std::max(weights_at_handle_kg(plant.mechanism, weights, pose), kLeastMass_kg);
  }
}

}  // namespace

std::optional<double> encoder_count_of(const firmware::DeviceConfig& config,
                                       const firmware::JointConfig& joint) {
  const auto& drive = config.axes[joint.encoder].drive;
  const double counts = drivers::visit_drive(drive, [](const auto& driver, const auto& settings) {
    return driver.counts_per_turn == nullptr ? 0.0 : driver.counts_per_turn(settings);
  });
  return counts > 0.0
             ? std::optional(2.0 * std::numbers::pi / (counts * joint.transmission.encoder_ratio))
             : std::nullopt;
}

DevicePreset described_device(const firmware::DeviceConfig& config) {
  const std::string name(config.preset);
  const std::optional<DevicePreset> named = device_preset(name);
  const std::optional<firmware::ControllerConfig> usual = firmware::preset_config(name);
  if (!named || !usual) {
    throw InputError(fmt::format("[mechanism] kind: there is no simulated '{}'", name));
  }
  DevicePreset device = *named;
  PlantParameters& plant = device.device.plant;
  const PlantMechanism mechanism = plant_mechanism(config.controller.mechanism);
  const bool has_usual_lengths = mechanism == plant_mechanism(usual->mechanism);
  if (!has_usual_lengths || !same_limits(config.controller, *usual)) {
    take_workspace(config, mechanism, device);
  }
  if (!has_usual_lengths) {
    plant.mechanism = mechanism;
  }
  if (!(has_usual_lengths &&
        plant_weights(config.controller.mechanism) == plant_weights(usual->mechanism))) {
    take_weights(config.controller, device);
  }
  plant.gravity_B = config.controller.gravity_D;
  plant.moving_mass_kg = config.plant.moving_mass_kg.value_or(plant.moving_mass_kg);
  plant.viscous_Ns_per_m = config.plant.viscous_Ns_per_m.value_or(plant.viscous_Ns_per_m);
  take_friction(config.plant, plant.joint_friction);
  take_electronics(config, *usual, device.device);
  return device;
}

}  // namespace tactus::host
