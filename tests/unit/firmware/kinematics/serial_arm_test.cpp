#include "firmware/kinematics/serial_arm.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>

#include "firmware/configuration/controller_config.h"
#include "tests/support/share.h"
#include "tests/unit/firmware/kinematics/random_joints.h"

namespace tactus::firmware {
namespace {

constexpr double kArmDegree = std::numbers::pi / 180.0;

// The published frames have x outward, y to the right and z up.
Vec3 in_device(const Vec3& outward_right_up) {
  return {outward_right_up.y(), outward_right_up.z(), outward_right_up.x()};
}

struct ArmPoint {
  Vec3 joints_deg;
  Vec3 published;  // outward, right, up
};

TEST(PhantomPremium, ForwardGivesThePublishedCheckPoints) {
  const SerialArm arm{SerialArmGeometry{}};
  const std::array<ArmPoint, 4> points = {{{{0.0, 0.0, 0.0}, {0.20955, 0.0, -0.169545}},
                                           {{0.0, 0.0, 90.0}, {0.379095, 0.0, 0.0}},
                                           {{30.0, 20.0, 40.0}, {0.264912, 0.152947, -0.058209}},
                                           {{-20.0, 45.0, 30.0}, {0.218898, -0.079672, 0.001344}}}};
  for (const ArmPoint& point : points) {
    const Pose pose = arm.forward(point.joints_deg * kArmDegree);
    EXPECT_LT((pose.p_D - in_device(point.published)).cwiseAbs().maxCoeff(), 0.6e-6)
        << point.joints_deg.transpose();
    // The second is stretched out.
    const bool stretched = point.joints_deg.z() == 90.0;
    EXPECT_EQ(pose.status, stretched ? kPoseSingular : kPoseGood);
  }
}

TEST(PhantomPremium, TheJointTorquesOfAForceAreThePublishedOnes) {
  const SerialArm arm{SerialArmGeometry{}};
  const Pose pose = arm.forward(Vec3(30.0, 20.0, 40.0) * kArmDegree);
  const Vec3 torque = joint_effort(pose, in_device({1.0, 2.0, 3.0}));
  EXPECT_LT((torque - Vec3(0.376877, 0.456999, 0.569302)).cwiseAbs().maxCoeff(), 0.6e-6);
}

// Published in WoodenHaptics' own angles, whose second is from the vertical, and from its own
// origin at (0.22, 0, 0.08).
TEST(WoodenHaptics, ForwardGivesThePublishedCheckPoints) {
  const ControllerConfig config = woodenhaptics_config();
  const SerialArm arm{std::get<SerialArmGeometry>(config.mechanism)};
  const std::array<ArmPoint, 5> points = {{{{0.0, 0.0, 90.0}, {0.0250, 0.0, 0.2050}},
                                           {{0.0, 30.0, 90.0}, {0.1275, 0.0, 0.177535}},
                                           {{20.0, 10.0, 70.0}, {0.029792, 0.090917, 0.118091}},
                                           {{-15.0, -20.0, 100.0}, {-0.054668, -0.0443, 0.235181}},
                                           {{9.0, 7.5, 90.0}, {0.048412, 0.042512, 0.203246}}}};
  for (const ArmPoint& point : points) {
    const Vec3 theirs = point.joints_deg;
    const Pose pose = arm.forward(Vec3(theirs.x(), 90.0 - theirs.y(), theirs.z()) * kArmDegree);
    const Vec3 tool = pose.p_D - config.workspace_origin_D;
    EXPECT_LT((tool - in_device(point.published)).cwiseAbs().maxCoeff(), 0.6e-6)
        << theirs.transpose();
    EXPECT_EQ(pose.status, kPoseGood);
  }
}

// Two links as bodies, swung up from hanging straight down and then turned about the vertical.
TEST(SerialArm, ForwardIsTheChainOfTurnedLinks) {
  RandomJoints random(20261203);
  const SerialArmGeometry g{.upper_m = 0.17, .forearm_m = 0.13, .shoulder_height_m = 0.058};
  const SerialArm arm{g};
  const auto rotated = [](double angle, const Vec3& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 joints = 3.0 * random.vector();
    const Vec3 hanging = -Vec3::UnitY();
    const Vec3 reach =
        g.upper_m * (rotated(joints.y() + 0.5 * std::numbers::pi, -Vec3::UnitX()) * hanging) +
        g.forearm_m * (rotated(joints.z(), -Vec3::UnitX()) * hanging);
    const Vec3 tool =
        Vec3(0.0, g.shoulder_height_m, 0.0) + rotated(joints.x(), Vec3::UnitY()) * reach;
    ASSERT_LT((arm.forward(joints).p_D - tool).norm(), 1e-15);
  }
}

TEST(SerialArm, TheInverseTakesTheBranchThatIsNearest) {
  const SerialArm arm{SerialArmGeometry{}};
  RandomJoints random(20261204);
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 joints = 6.0 * random.vector();
    const Pose pose = arm.forward(joints);
    if (pose.status != kPoseGood) {
      continue;
    }
    const auto back = arm.inverse(pose.p_D, joints + 0.02 * random.vector());
    ASSERT_TRUE(back);
    ASSERT_LT((*back - joints).norm(), 1e-9) << joints.transpose();
  }
}

TEST(SerialArm, ToolsOnTheFirstAxisAndLinksInOneLineAreFlaggedAndGiveNoTorque) {
  const SerialArm arm{SerialArmGeometry{}};
  const SerialArmGeometry g;
  // Within the PHANToM's own limits: leaning back until the tool is under the first axis.
  const double forearm = -29.0 * kArmDegree;
  const double upper = -std::acos(-g.forearm_m * std::sin(forearm) / g.upper_m);
  ASSERT_GT((upper - forearm) / kArmDegree, -55.0);
  for (const Vec3& joints : {Vec3(0.3, upper, forearm), Vec3(0.0, 0.0, 90.0 * kArmDegree),
                             Vec3(0.5, 0.2, 0.2 - 90.0 * kArmDegree)}) {
    const Pose pose = arm.forward(joints);
    EXPECT_EQ(pose.status, kPoseSingular) << joints.transpose();
    EXPECT_TRUE(pose.p_D.allFinite());
    EXPECT_EQ(joint_effort(pose, {8.0, 8.0, 8.0}), Vec3::Zero());
  }
}

// Every force has its effort where a pose passes: none of the Jacobian's gains is lost.
TEST(SerialArm, EveryPoseThatPassesIsWellPosed) {
  const SerialArm arm{SerialArmGeometry{}};
  RandomJoints random(20261205);
  int singular = 0;
  for (int i = 0; i < testing::share_of(50'000); ++i) {
    const Pose pose = arm.forward(3.2 * random.vector());
    singular += pose.status == kPoseSingular ? 1 : 0;
    if (pose.status == kPoseGood) {
      const Mat3 squared = pose.jacobian_D.transpose() * pose.jacobian_D;
      const Eigen::SelfAdjointEigenSolver<Mat3> solver(squared, Eigen::EigenvaluesOnly);
      ASSERT_GT(solver.eigenvalues()[0], 0.01 * 0.01);
    }
  }
  EXPECT_GT(singular, 0);
}

TEST(SerialArm, InverseIsEmptyOutOfReach) {
  const SerialArm arm{SerialArmGeometry{}};
  EXPECT_FALSE(arm.inverse({0.0, 0.0, 0.38}, Vec3::Zero()));
  EXPECT_FALSE(arm.inverse({0.0, 0.03, 0.0}, Vec3::Zero()));
  EXPECT_FALSE(arm.inverse({0.0, 0.0, 0.0}, Vec3::Zero()));
}

// A forearm drawn out level by its own weight and the tool's, against the moment by hand.
TEST(SerialArm, GravityTorquesAreTheMomentsOfTheWeights) {
  const SerialArm arm{SerialArmGeometry{.upper_m = 0.2,
                                        .forearm_m = 0.15,
                                        .upper = {.mass_kg = 0.3, .centre_m = 0.1},
                                        .forearm = {.mass_kg = 0.2, .centre_m = 0.05},
                                        .tool_kg = 0.1}};
  const Vec3 level = arm.gravity_effort({0.4, 0.0, 90.0 * kArmDegree}, {}, {0.0, -10.0, 0.0});
  EXPECT_NEAR(level.x(), 0.0, 1e-16);
  EXPECT_NEAR(level.y(), 10.0 * (0.3 * 0.1 + 0.3 * 0.2), 1e-15);
  EXPECT_NEAR(level.z(), 10.0 * (0.2 * 0.05 + 0.1 * 0.15), 1e-15);
  const Vec3 hanging = arm.gravity_effort({0.4, -90.0 * kArmDegree, 0.0}, {}, {0.0, -10.0, 0.0});
  EXPECT_LT(hanging.norm(), 1e-15);
}

}  // namespace
}  // namespace tactus::firmware
