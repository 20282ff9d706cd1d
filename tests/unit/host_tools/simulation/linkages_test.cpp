// The paddle, the pantograph and the serial arms of the plant, and what every mechanism of it must
// hold to.
#include "host_tools/simulation/linkages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/random.h"

namespace tactus::host {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

Vec3 joints_at(const PlantMechanism& kind, const Vec3& p_B) {
  MechanismPose pose;
  solve_mechanism(kind, p_B, pose);
  EXPECT_TRUE(pose.reachable) << p_B.transpose();
  Vec3 joints;
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    joints[static_cast<int>(i)] = joint_position(kind, i, pose.coordinate[i]);
  }
  return joints;
}

void expect_degrees(const PlantMechanism& kind, const Vec3& p_B, const Vec3& degrees,
                    double within_deg) {
  EXPECT_LT((joints_at(kind, p_B) / kRadPerDegree - degrees).cwiseAbs().maxCoeff(), within_deg)
      << p_B.transpose();
}

// Published as the length of the arc; the check points below are rounded to micrometres.
TEST(HapkitMechanism, MeetsThePublishedCheckPoints) {
  for (const auto& [angle_deg, arc_m] :
       {std::pair{4.9513, 5.674e-3}, std::pair{-5.7487, -6.588e-3}}) {
    const double angle = arc_m / PaddleLengths{}.radius_m;
    const Vec3 p_B(PaddleLengths{}.radius_m * std::sin(angle),
                   PaddleLengths{}.radius_m * std::cos(angle), 0.0);
    expect_degrees(PaddleLengths{}, p_B, {angle_deg, 0.0, 0.0}, 5e-4);
  }
}

TEST(HaplyMechanism, MeetsThePublishedCheckPoints) {
  const auto expect = [](double x, double z, double first_deg, double second_deg) {
    expect_degrees(PantographLengths{}, {x, 0.0, z}, {first_deg, second_deg, 0.0}, 2e-3);
  };
  expect(0.010000, 0.070376, 150.0, 30.0);
  expect(0.010000, 0.088674, 135.0, 45.0);
  expect(0.010000, 0.103923, 120.0, 60.0);
  expect(-0.007521, 0.074917, 160.0, 50.0);
  expect(0.043004, 0.082865, 110.0, 20.0);
  expect(0.010000, 0.045973, 170.0, 10.0);
  expect(0.010000, 0.036056, 180.0, 0.0);
}

// Published as outward, right and up.
TEST(PhantomMechanism, MeetsThePublishedCheckPoints) {
  const auto expect = [](const Vec3& outward_right_up, const Vec3& degrees) {
    const Vec3 p_B(outward_right_up.y(), outward_right_up.z(), outward_right_up.x());
    expect_degrees(kPhantomLengths, p_B, degrees, 1e-3);
  };
  expect({0.20955, 0.0, -0.169545}, {0.0, 0.0, 0.0});
  expect({0.264912, 0.152947, -0.058209}, {30.0, 20.0, 40.0});
  expect({0.218898, -0.079672, 0.001344}, {-20.0, 45.0, 30.0});
}

// Published in angles whose second is from the vertical, and from an origin at (0.22, 0, 0.08).
TEST(WoodenHapticsMechanism, MeetsThePublishedCheckPoints) {
  const auto expect = [](const Vec3& outward_right_up, const Vec3& degrees) {
    const Vec3 p_B(outward_right_up.y(), outward_right_up.z() + 0.08, outward_right_up.x() + 0.22);
    expect_degrees(kWoodenLengths, p_B, {degrees.x(), 90.0 - degrees.y(), degrees.z()}, 1e-3);
  };
  expect({0.0250, 0.0, 0.2050}, {0.0, 0.0, 90.0});
  expect({0.1275, 0.0, 0.177535}, {0.0, 30.0, 90.0});
  expect({0.029792, 0.090917, 0.118091}, {20.0, 10.0, 70.0});
  expect({0.048412, 0.042512, 0.203246}, {9.0, 7.5, 90.0});
}

class EveryPlantMechanism : public ::testing::TestWithParam<std::string_view> {
 protected:
  // Returns a place in the box of the stops without its outer tenth: the Falcon's legs do not reach
  // its corners.
  Vec3 random_place() {
    const PlantParameters& plant = preset_.device.plant;
    Vec3 p_B = preset_.centre_B;
    for (int axis = 0; axis < 3; ++axis) {
      const double range_m = plant.stop_upper_B[axis] - plant.stop_lower_B[axis];
      p_B[axis] = plant.stop_lower_B[axis] + random_.uniform(0.1, 0.9) * range_m;
    }
    return on_manifold(kind_, p_B);
  }

  const DevicePreset preset_ = *device_preset(GetParam());
  const PlantMechanism& kind_ = preset_.device.plant.mechanism;
  SplitMix64 random_{7};
};

TEST_P(EveryPlantMechanism, RowsAreTheSlopesOfTheJointsAlongWhatTheHandleMovesOn) {
  constexpr double kStep_m = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p_B = random_place();
    const Vec3 direction = along_manifold(
        kind_, p_B,
        Vec3(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0)));
    MechanismPose pose;
    solve_mechanism(kind_, p_B, pose);
    const Vec3 ahead = joints_at(kind_, on_manifold(kind_, p_B + kStep_m * direction));
    const Vec3 behind = joints_at(kind_, on_manifold(kind_, p_B - kStep_m * direction));
    const Vec3 slope = (ahead - behind) / (2.0 * kStep_m);
    for (std::size_t joint = 0; joint < kPlantJoints; ++joint) {
      EXPECT_NEAR(pose.rows[joint].dot(direction), slope[static_cast<int>(joint)],
                  1e-6 * (1.0 + pose.rows[joint].norm()))
          << "at " << p_B.transpose();
    }
  }
}

TEST_P(EveryPlantMechanism, TheElbowsPullIsTheSlopeOfTheirHeight) {
  constexpr double kStep_m = 1e-6;
  const Vec3 gravity_B(2.0, -9.0, 3.0);
  const auto height = [&](const Vec3& p_B) {
    MechanismPose pose;
    solve_mechanism(kind_, p_B, pose);
    return gravity_B.dot(elbow_sum(kind_, pose));
  };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p_B = random_place();
    MechanismPose pose;
    solve_mechanism(kind_, p_B, pose);
    const Vec3 direction = along_manifold(
        kind_, p_B, Vec3(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), 0.5));
    const Vec3 step = kStep_m * direction;
    const double slope = (height(p_B + step) - height(p_B - step)) / (2.0 * kStep_m);
    EXPECT_NEAR(elbow_pull(kind_, pose, gravity_B).dot(direction), slope,
                1e-5 * (1.0 + std::abs(slope)))
        << "at " << p_B.transpose();
  }
}

TEST_P(EveryPlantMechanism, TheWholeWorkspaceIsReachable) {
  const PlantParameters& plant = preset_.device.plant;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p_B;
    for (int axis = 0; axis < 3; ++axis) {
      p_B[axis] = ((corner >> axis) & 1) != 0 ? plant.stop_upper_B[axis] : plant.stop_lower_B[axis];
    }
    MechanismPose pose;
    solve_mechanism(kind_, on_manifold(kind_, p_B), pose);
    // The Falcon's far corners are beyond its legs.
    EXPECT_TRUE(pose.reachable || std::holds_alternative<DeltaLengths>(kind_)) << p_B.transpose();
  }
}

TEST_P(EveryPlantMechanism, StaysFiniteWhereTheLinksDoNotReach) {
  for (const Vec3& p_B : {Vec3(0.0, 0.0, 0.9), Vec3(0.7, 0.0, 0.1), Vec3(0.0, 0.0, 0.0)}) {
    MechanismPose pose;
    solve_mechanism(kind_, p_B, pose);
    for (const Vec3& row : pose.rows) {
      EXPECT_TRUE(row.allFinite()) << p_B.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryPlantMechanism,
                         ::testing::Values("cartesian", "falcon", "hapkit", "haply_pantograph",
                                           "phantom_premium", "woodenhaptics"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace tactus::host
