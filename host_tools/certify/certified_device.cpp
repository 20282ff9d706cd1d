#include "host_tools/certify/certified_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "host_tools/simulation/described_device.h"
#include "host_tools/simulation/device_workspace.h"

namespace tactus::host {
namespace {

// How far from the middle to the stops the outer places lie, and the largest press on a wall.
constexpr double kReach = 0.6;
constexpr double kMostPress_N = 2.0;

// A point of the workspace and its name.
struct Place {
  Vec3 point_B = Vec3::Zero();
  std::string name;
};

// Returns the middle of the workspace and a place toward each stop, moved onto the manifold. Places
// that fall together there count once.
std::vector<Place> places_in(const DevicePreset& preset) {
  const PlantParameters& plant = preset.device.plant;
  const PlantMechanism& kind = plant.mechanism;
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
  const bool slides = std::holds_alternative<CartesianAxes>(device.plant.mechanism);
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
  DevicePreset preset = described_device(config);
  preset.device.plant.elbow_kg = 0.0;
  preset.device.plant.handle_kg = 0.0;
  // The strongest joint's own limit counts, even where a preset's motors give less.
  preset.device.effort_limit = 0.0;
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    preset.device.effort_limit = std::max(preset.device.effort_limit, joint.limits.max_effort);
  }
  const PlantMechanism& kind = preset.device.plant.mechanism;
  WallContact contact{.device = preset.device, .controller = config.controller};
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
