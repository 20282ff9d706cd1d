#include "host_tools/reach/reach_map.h"

#include <algorithm>
#include <cmath>

#include "host_tools/simulation/described_device.h"
#include "host_tools/simulation/described_mechanism.h"
#include "host_tools/simulation/device_workspace.h"
#include "host_tools/simulation/grid_share.h"

namespace tactus::host {

std::optional<double> drive_torque_Nm(const firmware::AxisConfig& axis) {
  return std::visit(
      [](const auto& drive) -> std::optional<double> {
        if constexpr (requires { drive.max_torque_Nm; }) {
          return drive.max_torque_Nm;
        } else if constexpr (requires { drive.bridge.max_torque_Nm; }) {
          return drive.bridge.max_torque_Nm;
        } else {
          return std::nullopt;
        }
      },
      axis.drive);
}

ReachMap::ReachMap(const firmware::DeviceConfig& config)
    : config_(&config), device_(described_device(config)), mechanism_(config.controller.mechanism) {
  for (std::size_t i = 0; i < config.joint_count; ++i) {
    const firmware::JointConfig& joint = config.joints[i];
    effort_[i] = joint.limits.max_effort;
    if (const auto torque_Nm = drive_torque_Nm(config.axes[joint.motor])) {
      effort_[i] = std::min(effort_[i], *torque_Nm * joint.transmission.motor_ratio);
    }
    resolution_[i] = config.plant.encoder_resolution.value_or(
        encoder_count_of(config, joint).value_or(device_.device.encoder_resolution));
  }
}

// A count of joint i moves the handle by column i of the Jacobian. A unit force along a direction d
// needs the effort column . d of the joint, at most the column's length over all directions, so the
// force that a joint gives in every direction is its effort over that length.
std::optional<ReachPoint> ReachMap::at(const Vec3& p_B) const {
  const PlantMechanism& plant = device_.device.plant.mechanism;
  const Vec3 on_B = on_manifold(plant, p_B);
  const auto pose = rightly_seen_pose(config_->controller, plant, on_B);
  if (!pose) {
    return std::nullopt;
  }
  MechanismPose solved;
  solve_mechanism(plant, on_B, solved);
  const Vec3 weight =
      mechanism_.gravity_effort(joints_at(plant, solved), *pose, config_->controller.gravity_D);
  ReachPoint point{.force_N = 1e9};
  for (std::size_t i = 0; i < config_->joint_count; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double lever = pose->jacobian_D.col(column).norm();
    const double held = std::abs(weight[column]);
    point.resolution_m = std::max(point.resolution_m, lever * resolution_[i]);
    point.force_N = std::min(point.force_N, std::max(effort_[i] - held, 0.0) / lever);
    point.weight_share[i] = effort_[i] > 0.0 ? held / effort_[i] : 0.0;
  }
  return point;
}

ReachBox ReachMap::whole_box() const {
  const PlantParameters& plant = device_.device.plant;
  const Vec3 middle_B = device_.centre_B;
  // No link chain is longer than twice its length from a place that it reaches.
  const double radius_m = std::holds_alternative<CartesianAxes>(plant.mechanism)
                              ? 0.0
                              : 2.0 * whole_length_m(plant.mechanism);
  ReachBox box;
  box.include(plant.stop_lower_B);
  box.include(plant.stop_upper_B);
  constexpr int kSide = 33;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3 p_B = middle_B + radius_m * (2.0 * grid_share(i, kSide) - Vec3::Ones());
    if (at(p_B)) {
      box.include(on_manifold(plant.mechanism, p_B));
    }
  }
  return box;
}

}  // namespace tactus::host
