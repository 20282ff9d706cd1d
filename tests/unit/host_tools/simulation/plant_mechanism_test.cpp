#include "host_tools/simulation/plant_mechanism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host_tools/simulation/random.h"

namespace tactus::host {
namespace {

Vec3 angles_deg(const Vec3& p_B) {
  MechanismPose pose;
  solve_mechanism(DeltaLengths{}, p_B, pose);
  EXPECT_TRUE(pose.reachable);
  Vec3 degrees;
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    degrees[static_cast<int>(i)] =
        joint_position(DeltaLengths{}, i, pose.coordinate[i]) * 180.0 / std::numbers::pi;
  }
  return degrees;
}

// The fact sheet's published check points.
TEST(FalconMechanism, MeetsThePublishedCheckPoints) {
  const auto expect = [](const Vec3& p_B, const Vec3& degrees) {
    EXPECT_LT((angles_deg(p_B) - degrees).cwiseAbs().maxCoeff(), 1e-6);
  };
  expect({0.0, 0.0, 0.08}, Vec3::Constant(-11.800048));
  expect({0.0, 0.0, 0.11}, Vec3::Constant(16.18796));
  expect({0.0, 0.0, 0.14}, Vec3::Constant(39.173272));
  expect({0.02, 0.0, 0.11}, {22.198145, 3.803494, 27.362316});
  expect({-0.03, 0.02, 0.13}, {19.830579, 54.565724, 34.155734});
  expect({0.01, -0.015, 0.12}, {35.773455, 16.687995, 22.885544});
}

TEST(FalconMechanism, RowsAreTheSlopesOfTheJointAngles) {
  const double step = 1e-6;
  SplitMix64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p_B(random.uniform(-0.045, 0.045), random.uniform(-0.045, 0.045),
                   random.uniform(0.08, 0.16));
    MechanismPose pose;
    solve_mechanism(DeltaLengths{}, p_B, pose);
    if (!pose.reachable) {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 delta = step * Vec3::Unit(axis);
      const Vec3 slope_rad = (angles_deg(p_B + delta) - angles_deg(p_B - delta)) *
                             std::numbers::pi / 180.0 / (2.0 * step);
      for (std::size_t joint = 0; joint < kPlantJoints; ++joint) {
        EXPECT_NEAR(pose.rows[joint][axis], slope_rad[static_cast<int>(joint)],
                    1e-6 * (1.0 + std::abs(pose.rows[joint][axis])))
            << "at " << p_B.transpose();
      }
    }
  }
}

TEST(FalconMechanism, StaysFiniteWhereTheLegsDoNotReach) {
  for (const Vec3& p_B : {Vec3(0.0, 0.0, 0.3), Vec3(0.2, 0.0, 0.1), Vec3(0.0, 0.0, 0.0)}) {
    MechanismPose pose;
    solve_mechanism(DeltaLengths{}, p_B, pose);
    EXPECT_FALSE(pose.reachable);
    for (const Vec3& row : pose.rows) {
      EXPECT_TRUE(row.allFinite());
    }
  }
}

}  // namespace
}  // namespace tactus::host
