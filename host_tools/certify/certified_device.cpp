#include "host_tools/certify/certified_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "host_tools/input_error.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {
namespace {

// How far from the middle to the stops the outer places lie, and the largest press on a wall.
constexpr double kReach = 0.6;
constexpr double kMostPress_N = 2.0;

// Returns the joints' positions, rad or m.
Vec3 joints_at(MechanismKind kind, const MechanismPose& pose) {
  return {joint_position(kind, 0, pose.coordinate[0]), joint_position(kind, 1, pose.coordinate[1]),
          joint_position(kind, 2, pose.coordinate[2])};
}

// Returns where the controller believes the handle to be; nothing if the mechanism does not reach
// there, is singular, or is beyond its joints' limits.
std::optional<firmware::Pose> controller_pose(const firmware::ControllerConfig& config,
                                              MechanismKind kind, const Vec3& point_B) {
  MechanismPose pose;
  solve_mechanism(kind, point_B, pose);
  const Vec3 joints = joints_at(kind, pose);
  for (std::size_t i = 0; i < joints_of(kind); ++i) {
    const double joint = joints[static_cast<Eigen::Index>(i)];
    if (joint < config.joints[i].lower || joint > config.joints[i].upper) {
      return std::nullopt;
    }
  }
  const firmware::Pose seen = firmware::Mechanism(config.mechanism).forward(joints, point_B);
  return pose.reachable && seen.status == firmware::kPoseGood ? std::optional(seen) : std::nullopt;
}

// Returns the preset whose joints mean the same points to the controller. Two points are compared,
// since different lengths can agree at one.
DevicePreset matching_preset(const firmware::ControllerConfig& config) {
  constexpr double kSame_m = 2e-4;
  for (const std::string_view name : firmware::kPresetNames) {
    const std::optional<DevicePreset> preset = device_preset(name);
    if (!preset) {
      continue;
    }
    const MechanismKind kind = preset->device.plant.mechanism;
    const std::array<Vec3, 2> points_B = {preset->centre_B,
                                          preset->centre_B + Vec3::Constant(0.01)};
    const auto is_seen_right = [&](const Vec3& point_B) {
      const Vec3 on_B = on_manifold(kind, point_B);
      const auto seen = controller_pose(config, kind, on_B);
      return seen && (seen->p_D - on_B).norm() < kSame_m;
    };
    if (joints_of(kind) == firmware::joint_count(config.mechanism) &&
        std::ranges::all_of(points_B, is_seen_right)) {
      return *preset;
    }
  }
  throw InputError(fmt::format(
      "[mechanism] has lengths that no simulated device has; certify knows {} as their presets are",
      fmt::join(firmware::kPresetNames, ", ")));
}

// Returns the size of a count of the joint's encoder, if the file tells it.
std::optional<double> resolution_of(const firmware::DeviceConfig& config,
                                    const firmware::JointConfig& joint) {
  const auto& drive = config.axes[joint.encoder].drive;
  const double counts = drivers::visit_drive(drive, [](const auto& driver, const auto& settings) {
    return driver.counts_per_turn == nullptr ? 0.0 : driver.counts_per_turn(settings);
  });
  return counts > 0.0
             ? std::optional(2.0 * std::numbers::pi / (counts * joint.transmission.encoder_ratio))
             : std::nullopt;
}

// Returns the preset with what the file says about the plant, encoders and motors.
DeviceParameters parameters_of(const firmware::DeviceConfig& config, const DevicePreset& preset) {
  DeviceParameters device = preset.device;
  const firmware::PlantConfig& given = config.plant;
  PlantParameters& plant = device.plant;
  rendering::FrictionParameters& friction = plant.joint_friction;
  double resolution = 0.0;
  device.effort_limit = 0.0;
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    resolution = std::max(resolution, resolution_of(config, joint).value_or(0.0));
    device.effort_limit = std::max(device.effort_limit, joint.limits.max_effort);
  }
  plant.elbow_kg = 0.0;
  plant.handle_kg = 0.0;
  plant.moving_mass_kg = given.moving_mass_kg.value_or(plant.moving_mass_kg);
  plant.viscous_Ns_per_m = given.viscous_Ns_per_m.value_or(plant.viscous_Ns_per_m);
  if (given.coulomb_friction) {
    // Friction is scaled so that the bristles' deflection stays the same. Their damping then grows
    // with the square root, which keeps the damping ratio.
    const double share = friction.coulomb > 0.0 ? *given.coulomb_friction / friction.coulomb : 0.0;
    friction.coulomb = *given.coulomb_friction;
    friction.static_level = given.breakaway_friction.value_or(*given.coulomb_friction);
    friction.stiffness_N_per_m *= share;
    friction.damping_s_per_m *= std::sqrt(share);
    if (friction.static_level == 0.0) {
      friction = {};
    }
  }
  device.encoder_resolution =
      given.encoder_resolution.value_or(resolution > 0.0 ? resolution : device.encoder_resolution);
  device.velocity_cutoff_Hz = given.velocity_cutoff_hz.value_or(device.velocity_cutoff_Hz);
  device.motor_time_constant_s = given.motor_time_constant_s.value_or(device.motor_time_constant_s);
  device.delay_ticks = given.delay_ticks.value_or(static_cast<std::uint32_t>(device.delay_ticks));
  return device;
}

// A point of the workspace and its name.
struct Place {
  Vec3 point_B = Vec3::Zero();
  std::string name;
};

// Returns the middle of the workspace and a place toward each stop, moved onto the manifold. Places
// that fall together there count once.
std::vector<Place> places_in(const DevicePreset& preset) {
  const PlantParameters& plant = preset.device.plant;
  const MechanismKind kind = plant.mechanism;
  std::vector<Place> places{{on_manifold(kind, preset.centre_B), "the middle"}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3& stop_B = side < 0.0 ? plant.stop_lower_B : plant.stop_upper_B;
      Vec3 point_B = preset.centre_B;
      point_B[axis] += kReach * (stop_B[axis] - point_B[axis]);
      point_B = on_manifold(kind, point_B);
      const bool is_new = std::ranges::none_of(
          places, [&](const Place& other) { return (other.point_B - point_B).norm() < 1e-3; });
      if (is_new) {
        places.push_back({point_B, fmt::format("{}{}", side < 0.0 ? '-' : '+', "xyz"[axis])});
      }
    }
  }
  return places;
}

// Returns the force with which the wall is pressed there: half of what the motors can hold, at most
// 2 N.
double press_at(const firmware::ControllerConfig& config, const firmware::Pose& pose,
                const Vec3& normal_B) {
  const Vec3 effort = firmware::joint_effort(pose, normal_B);
  double most_N = config.safety.max_force_N;
  for (std::size_t i = 0; i < firmware::joint_count(config.mechanism); ++i) {
    const double per_N = std::abs(effort[static_cast<Eigen::Index>(i)]);
    most_N = per_N > 0.0 ? std::min(most_N, config.joints[i].max_effort / per_N) : most_N;
  }
  return std::min(kMostPress_N, 0.5 * most_N);
}

// Returns the description of the simulation that the certificate keeps.
std::string in_words(const DeviceParameters& device, const firmware::ControllerConfig& config,
                     std::size_t places) {
  const bool slides = device.plant.mechanism == MechanismKind::cartesian;
  const rendering::FrictionParameters& friction = device.plant.joint_friction;
  return fmt::format(
      "simulation: {:.6g} Hz, {:.6g} kg, {:.6g} N s/m, joint friction {:.6g} {} (break-away "
      "{:.6g}), "
      "encoder {:.6g} {}, velocity to {:.6g} Hz, command delay {} ticks, motor {:.6g} ms, {} walls",
      config.rate_hz, device.plant.moving_mass_kg, device.plant.viscous_Ns_per_m, friction.coulomb,
      slides ? "N" : "N m", friction.static_level, device.encoder_resolution, slides ? "m" : "rad",
      device.velocity_cutoff_Hz, device.delay_ticks, 1e3 * device.motor_time_constant_s, places);
}

}  // namespace

CertifiedDevice certified_device(const firmware::DeviceConfig& config) {
  const DevicePreset preset = matching_preset(config.controller);
  const MechanismKind kind = preset.device.plant.mechanism;
  WallContact contact{.device = parameters_of(config, preset), .controller = config.controller};
  contact.controller.gravity_D.setZero();
  contact.controller.certificate = {};
  CertifiedDevice certified;
  for (const Place& place : places_in(preset)) {
    const auto pose = controller_pose(config.controller, kind, place.point_B);
    for (int axis = 0; pose && axis < 3; ++axis) {
      // The free side is toward the middle.
      const double side = place.point_B[axis] > preset.centre_B[axis] ? -1.0 : 1.0;
      const Vec3 along_B = along_manifold(kind, place.point_B, side * Vec3::Unit(axis));
      // On an arc or a plane a wall is certified only across directions in which the handle really
      // moves.
      constexpr double kMostlyAlong = 0.7;
      if (along_B.norm() > kMostlyAlong) {
        contact.point_B = place.point_B;
        contact.normal_B = along_B.normalized();
        contact.press_N = press_at(config.controller, *pose, contact.normal_B);
        certified.places.push_back(
            {contact, fmt::format("a wall across {} at {}", "xyz"[axis], place.name)});
      }
    }
  }
  certified.measured_with = in_words(contact.device, contact.controller, certified.places.size());
  return certified;
}

}  // namespace tactus::host
