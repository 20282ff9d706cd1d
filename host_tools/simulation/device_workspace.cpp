#include "host_tools/simulation/device_workspace.h"

#include <algorithm>
#include <cmath>

#include "host_tools/simulation/grid_share.h"

namespace tactus::host {
namespace {

// The distance from the joints' limits to the stops, rad or m: a stop gives way a little.
constexpr double kLimitMargin = 0.02;
constexpr double kSlideMargin_m = 0.002;

// The search for a box: everything that stays the same in it.
struct BoxSearch {
  const firmware::ControllerConfig* config = nullptr;
  const PlantMechanism* mechanism = nullptr;
  // Half of the box at the scale 1, m.
  Vec3 half_m = Vec3::Zero();

  [[nodiscard]] bool is_inside(const Vec3& p_B) const {
    return rightly_seen_pose(*config, *mechanism, on_manifold(*mechanism, p_B), kLimitMargin)
        .has_value();
  }

  // Returns true if a box of this scale is inside: its corners and the middles of its edges and
  // sides.
  [[nodiscard]] bool fits(const Vec3& centre_B, double scale) const {
    constexpr int kPlaces = 27;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec3 side = 2.0 * grid_share(i, 3) - Vec3::Ones();
      if (!is_inside(centre_B + scale * side.cwiseProduct(half_m))) {
        return false;
      }
    }
    return true;
  }

  // Returns the largest scale of a box there that is larger than `than`; `than` if there is none.
  [[nodiscard]] double room_at(const Vec3& centre_B, double than) const {
    constexpr double kStep = 0.05;
    constexpr double kMost = 1.5;
    double scale = than;
    while (scale + kStep <= kMost && fits(centre_B, scale + kStep)) {
      scale += kStep;
    }
    return scale;
  }
};

DeviceWorkspace sliding_workspace(const firmware::ControllerConfig& config) {
  DeviceWorkspace box;
  for (int axis = 0; axis < 3; ++axis) {
    const firmware::JointLimits& limits = config.joints[static_cast<std::size_t>(axis)];
    box.lower_B[axis] = limits.lower + kSlideMargin_m;
    box.upper_B[axis] = limits.upper - kSlideMargin_m;
  }
  box.centre_B = 0.5 * (box.lower_B + box.upper_B);
  return box;
}

// Returns the box around the paddle's arc.
DeviceWorkspace arc_workspace(const firmware::ControllerConfig& config, double radius_m) {
  const double lower = config.joints[0].lower + kLimitMargin;
  const double upper = config.joints[0].upper - kLimitMargin;
  const auto at = [&](double angle) {
    return Vec3(radius_m * std::sin(angle), radius_m * std::cos(angle), 0.0);
  };
  DeviceWorkspace box{.centre_B = at(0.5 * (lower + upper)), .lower_B = at(lower), .upper_B = {}};
  box.upper_B = box.lower_B;
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p_B = at(lower + (upper - lower) * i / kSteps);
    box.lower_B = box.lower_B.cwiseMin(p_B);
    box.upper_B = box.upper_B.cwiseMax(p_B);
  }
  return box;
}

}  // namespace

Vec3 joints_at(const PlantMechanism& mechanism, const MechanismPose& pose) {
  return {joint_position(mechanism, 0, pose.coordinate[0]),
          joint_position(mechanism, 1, pose.coordinate[1]),
          joint_position(mechanism, 2, pose.coordinate[2])};
}

std::optional<firmware::Pose> controller_pose(const firmware::ControllerConfig& config,
                                              const PlantMechanism& mechanism, const Vec3& p_B,
                                              double margin) {
  MechanismPose pose;
  solve_mechanism(mechanism, p_B, pose);
  const Vec3 joints = joints_at(mechanism, pose);
  for (std::size_t i = 0; i < joints_of(mechanism); ++i) {
    const double joint = joints[static_cast<Eigen::Index>(i)];
    // A joint without a number, as of a paddle that points straight down, is beyond its limits.
    const bool is_within =
        joint >= config.joints[i].lower + margin && joint <= config.joints[i].upper - margin;
    if (!is_within) {
      return std::nullopt;
    }
  }
  for (const firmware::CoupledLimit& limit : config.coupled_limits) {
    const double difference = joints[static_cast<Eigen::Index>(limit.joint)] -
                              joints[static_cast<Eigen::Index>(limit.minus)];
    if (limit.joint != limit.minus &&
        (difference < limit.lower + margin || difference > limit.upper - margin)) {
      return std::nullopt;
    }
  }
  const firmware::Pose seen = firmware::Mechanism(config.mechanism).forward(joints, p_B);
  return pose.reachable && seen.status == firmware::kPoseGood ? std::optional(seen) : std::nullopt;
}

std::optional<firmware::Pose> rightly_seen_pose(const firmware::ControllerConfig& config,
                                                const PlantMechanism& mechanism, const Vec3& p_B,
                                                double margin) {
  constexpr double kSeenRight_m = 1e-4;
  const auto seen = controller_pose(config, mechanism, p_B, margin);
  return seen && (seen->p_D - p_B).norm() < kSeenRight_m ? seen : std::nullopt;
}

std::optional<DeviceWorkspace> find_workspace(const firmware::ControllerConfig& config,
                                              const PlantMechanism& mechanism,
                                              const DeviceWorkspace& like) {
  if (std::holds_alternative<CartesianAxes>(mechanism)) {
    return sliding_workspace(config);
  }
  if (const auto* const paddle = std::get_if<PaddleLengths>(&mechanism)) {
    return arc_workspace(config, paddle->radius_m);
  }
  const BoxSearch search{
      .config = &config, .mechanism = &mechanism, .half_m = 0.5 * (like.upper_B - like.lower_B)};
  constexpr double kEnough = 0.5;
  Vec3 centre_B = like.centre_B;
  double scale = search.room_at(centre_B, 0.0);
  if (scale < kEnough) {
    // Twice the box on each side of the preferred middle is as far as links of this length reach.
    constexpr int kSide = 9;
    constexpr double kSpread = 4.0;
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const Vec3 moved_B =
          kSpread * (2.0 * grid_share(i, kSide) - Vec3::Ones()).cwiseProduct(search.half_m);
      const double room = search.room_at(like.centre_B + moved_B, scale);
      if (room > scale) {
        scale = room;
        centre_B = like.centre_B + moved_B;
      }
    }
  }
  if (scale <= 0.0) {
    return std::nullopt;
  }
  const Vec3 half_m = scale * search.half_m;
  return DeviceWorkspace{
      .centre_B = centre_B, .lower_B = centre_B - half_m, .upper_B = centre_B + half_m};
}

}  // namespace tactus::host
