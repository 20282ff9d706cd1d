#include "firmware/kinematics/pantograph.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/share.h"
#include "tests/unit/firmware/kinematics/random_joints.h"

namespace tactus::firmware {
namespace {

constexpr double kBarDegree = std::numbers::pi / 180.0;
const Vec3 kBarMiddle(0.01, 0.0, 0.075);

Vec3 bar_angles(double first_deg, double second_deg) {
  return {first_deg * kBarDegree, second_deg * kBarDegree, 0.0};
}

struct BarPoint {
  double first_deg;
  double second_deg;
  double x;
  double z;
};

// Published for the Haply; its y is our z.
TEST(HaplyPantograph, ForwardAndInverseGiveThePublishedCheckPoints) {
  const std::array<BarPoint, 7> points = {{{150.0, 30.0, 0.010000, 0.070376},
                                           {135.0, 45.0, 0.010000, 0.088674},
                                           {120.0, 60.0, 0.010000, 0.103923},
                                           {160.0, 50.0, -0.007521, 0.074917},
                                           {110.0, 20.0, 0.043004, 0.082865},
                                           {170.0, 10.0, 0.010000, 0.045973},
                                           {180.0, 0.0, 0.010000, 0.036056}}};
  const Pantograph haply{PantographGeometry{}};
  for (const BarPoint& point : points) {
    const Pose pose = haply.forward(bar_angles(point.first_deg, point.second_deg), kBarMiddle);
    EXPECT_EQ(pose.status, kPoseGood) << point.first_deg;
    EXPECT_NEAR(pose.p_D.x(), point.x, 0.6e-6);
    EXPECT_EQ(pose.p_D.y(), 0.0);
    EXPECT_NEAR(pose.p_D.z(), point.z, 0.6e-6);
    const auto joints = haply.inverse(pose.p_D);
    ASSERT_TRUE(joints);
    EXPECT_NEAR((*joints)[0] / kBarDegree, point.first_deg, 1e-9);
    EXPECT_NEAR((*joints)[1] / kBarDegree, point.second_deg, 1e-9);
  }
}

TEST(HaplyPantograph, TheTransposedJacobianGivesThePublishedCheckPoints) {
  const Pantograph haply{PantographGeometry{}};
  const auto expect = [&](double first_deg, double second_deg, const Eigen::Matrix2d& transposed) {
    const Mat3 jacobian = haply.forward(bar_angles(first_deg, second_deg), kBarMiddle).jacobian_D;
    Eigen::Matrix2d ours;
    ours << jacobian(0, 0), jacobian(2, 0), jacobian(0, 1), jacobian(2, 1);
    EXPECT_LT((ours - transposed).cwiseAbs().maxCoeff(), 0.6e-7) << first_deg;
  };
  expect(150.0, 30.0,
         (Eigen::Matrix2d() << -0.0309314, -0.0363339, -0.0309314, 0.0363339).finished());
  expect(120.0, 60.0, (Eigen::Matrix2d() << -0.0433013, -0.025, -0.0433013, 0.025).finished());
  expect(160.0, 50.0,
         (Eigen::Matrix2d() << -0.0253708, -0.0413399, -0.0408953, 0.0279141).finished());
}

// Published: the largest force in the worst direction with 0.123 N m on each motor.
TEST(HaplyPantograph, TheMotorsGiveThePublishedForceInTheWorstDirection) {
  const Pantograph haply{PantographGeometry{}};
  const std::array<std::array<double, 3>, 5> points = {{{150.0, 30.0, 2.58},
                                                        {135.0, 45.0, 2.44},
                                                        {120.0, 60.0, 2.46},
                                                        {160.0, 50.0, 2.48},
                                                        {110.0, 20.0, 2.42}}};
  for (const auto& [first_deg, second_deg, force_N] : points) {
    const Mat3 jacobian = haply.forward(bar_angles(first_deg, second_deg), kBarMiddle).jacobian_D;
    EXPECT_NEAR(0.123 / jacobian.colwise().norm().maxCoeff(), force_N, 0.006) << first_deg;
  }
}

// The drawing: both distal links reach the tool, and it lies away from the base.
TEST(HaplyPantograph, TheLinksMeetAtTheTool) {
  RandomJoints random(20261201);
  const PantographGeometry g;
  const Pantograph haply{g};
  int met = 0;
  for (int i = 0; i < testing::share_of(50'000); ++i) {
    const Vec3 joints = 3.2 * random.vector();
    const Pose pose = haply.forward(joints, kBarMiddle);
    const auto elbow = [&](double base, double angle) {
      return Vec3(base + g.proximal_m * std::cos(angle), 0.0, g.proximal_m * std::sin(angle));
    };
    const Vec3 first = elbow(0.0, joints.x());
    const Vec3 second = elbow(g.base_m, joints.y());
    if (pose.status == kPoseNotConverged) {
      ASSERT_GT((second - first).norm(), 2.0 * g.distal_m);
      ASSERT_EQ(pose.p_D, kBarMiddle);
      continue;
    }
    ++met;
    // A rounding of the elbows is a long way of the tool where the links are in one line.
    ASSERT_NEAR((pose.p_D - first).norm(), g.distal_m, 1e-15);
    ASSERT_NEAR((pose.p_D - second).norm(), g.distal_m, 1e-15);
    if (second.x() > first.x()) {
      ASSERT_GE(pose.p_D.z(), 0.5 * (first.z() + second.z()));
    }
  }
  EXPECT_GT(met, 0);
}

// A tool at that distance from the first motor (side 1) or the second (side -1), seen in the
// mirror.
Vec3 tool_from_motor(double side, double distance_m, double direction_deg) {
  const PantographGeometry g;
  return Vec3(0.5 * g.base_m, 0.0, 0.0) +
         Vec3(side * (distance_m * std::cos(direction_deg * kBarDegree) - 0.5 * g.base_m), 0.0,
              distance_m * std::sin(direction_deg * kBarDegree));
}

TEST(HaplyPantograph, PosesNearASingularityAreFlaggedAndGiveNoTorque) {
  const PantographGeometry g;
  const Pantograph haply{g};
  const double crossing_deg = std::acos(0.5 * g.base_m / g.proximal_m) / kBarDegree;
  // Distal links nearly upon each other.
  std::vector<Vec3> singular = {bar_angles(crossing_deg + 1.0, 180.0 - crossing_deg - 1.0)};
  for (const double side : {1.0, -1.0}) {
    // One side's links stretched out, and folded.
    for (const Vec3& tool :
         {tool_from_motor(side, 0.11999, 80.0), tool_from_motor(side, 0.02001, 100.0)}) {
      const auto joints = haply.inverse(tool);
      ASSERT_TRUE(joints) << tool.transpose();
      singular.emplace_back((*joints)[0], (*joints)[1], 0.0);
    }
  }
  for (const Vec3& joints : singular) {
    const Pose pose = haply.forward(joints, kBarMiddle);
    EXPECT_EQ(pose.status, kPoseSingular) << joints.transpose() / kBarDegree;
    EXPECT_EQ(joint_effort(pose, {8.0, 8.0, 8.0}), Vec3::Zero());
  }
}

TEST(HaplyPantograph, ElbowsInOnePlaceOrTooFarApartAreFlagged) {
  const PantographGeometry g;
  const double crossing_deg = std::acos(0.5 * g.base_m / g.proximal_m) / kBarDegree;
  const Vec3 in_one_place = bar_angles(crossing_deg, 180.0 - crossing_deg);
  EXPECT_NE(Pantograph{g}.forward(in_one_place, kBarMiddle).status, kPoseGood);
  const Pantograph wide{PantographGeometry{.base_m = 0.08}};
  const Pose apart = wide.forward(bar_angles(180.0, 0.0), kBarMiddle);
  EXPECT_EQ(apart.status, kPoseNotConverged);
  EXPECT_EQ(apart.p_D, kBarMiddle);
}

TEST(HaplyPantograph, EveryPoseThatPassesIsWellPosed) {
  RandomJoints random(20261202);
  const Pantograph haply{PantographGeometry{}};
  for (int i = 0; i < testing::share_of(100'000); ++i) {
    const Pose pose = haply.forward(3.2 * random.vector(), kBarMiddle);
    if (pose.status == kPoseGood) {
      Eigen::Matrix2d jacobian;
      jacobian << pose.jacobian_D(0, 0), pose.jacobian_D(0, 1), pose.jacobian_D(2, 0),
          pose.jacobian_D(2, 1);
      // The squares of the singular values add up to that of the norm; their product is the
      // determinant's size.
      const double product = std::abs(jacobian.determinant());
      const double squares = jacobian.squaredNorm();
      const double largest = 0.5 * (std::sqrt(squares + 2.0 * product) +
                                    std::sqrt(std::max(squares - 2.0 * product, 0.0)));
      ASSERT_LT(largest, 0.75);
      ASSERT_GT(product / largest, 0.001);
    }
  }
}

TEST(HaplyPantograph, InverseIsEmptyOutOfReach) {
  const Pantograph haply{PantographGeometry{}};
  EXPECT_FALSE(haply.inverse({0.01, 0.0, 0.125}));
  EXPECT_FALSE(haply.inverse({0.0, 0.0, 0.01}));
  EXPECT_FALSE(haply.inverse({0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace tactus::firmware
