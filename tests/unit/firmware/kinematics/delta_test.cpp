#include "firmware/kinematics/delta.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "tests/support/share.h"
#include "tests/unit/firmware/kinematics/delta_chain.h"

namespace tactus::firmware {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const Vec3 kMiddle(0.0, 0.0, 0.12);

class FalconDelta : public ::testing::Test {
 protected:
  // A tool position within `radius` of the workspace's middle.
  Vec3 random_tool(double radius) {
    Vec3 offset;
    do {
      offset = {unit_(generator_), unit_(generator_), unit_(generator_)};
    } while (offset.norm() > 1.0);
    return kMiddle + radius * offset;
  }

  double random_unit() { return unit_(generator_); }
  void start(std::uint64_t seed) {
    generator_.seed(seed);
    RecordProperty("seed", std::to_string(seed));
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  }

  Delta delta_{DeltaGeometry{}};

 private:
  std::mt19937_64 generator_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

struct CheckPoint {
  Vec3 joints_deg;
  Vec3 tool;
};

TEST_F(FalconDelta, ForwardGivesThePublishedCheckPoints) {
  const std::array<CheckPoint, 5> points = {{
      {{35.0, 35.0, 35.0}, {0.0, 0.0, 0.134602}},
      {{-1.434659, -1.434659, -1.434659}, {0.0, 0.0, 0.089611}},
      {{71.434659, 71.434659, 71.434659}, {0.0, 0.0, 0.173603}},
      {{16.78267, 42.28693, 24.06960}, {-0.022420, 0.011715, 0.121927}},
      {{53.21733, 9.49574, 38.64347}, {0.033343, -0.024734, 0.124511}},
  }};
  for (const CheckPoint& point : points) {
    const Pose pose = delta_.forward(point.joints_deg * kDegree, kMiddle);
    EXPECT_EQ(pose.status, kPoseGood);
    EXPECT_LT((pose.p_D - point.tool).cwiseAbs().maxCoeff(), 0.6e-6) << point.tool.transpose();
  }
}

TEST_F(FalconDelta, InverseGivesThePublishedCheckPoints) {
  const std::array<CheckPoint, 7> points = {{
      {{-11.800048, -11.800048, -11.800048}, {0.0, 0.0, 0.08}},
      {{16.18796, 16.18796, 16.18796}, {0.0, 0.0, 0.11}},
      {{39.173272, 39.173272, 39.173272}, {0.0, 0.0, 0.14}},
      {{22.198145, 3.803494, 27.362316}, {0.02, 0.0, 0.11}},
      {{4.012566, 21.438766, 27.906229}, {0.0, 0.02, 0.11}},
      {{19.830579, 54.565724, 34.155734}, {-0.03, 0.02, 0.13}},
      {{35.773455, 16.687995, 22.885544}, {0.01, -0.015, 0.12}},
  }};
  for (const CheckPoint& point : points) {
    const auto joints = delta_.inverse(point.tool);
    ASSERT_TRUE(joints);
    EXPECT_LT((*joints / kDegree - point.joints_deg).cwiseAbs().maxCoeff(), 5e-6)
        << point.tool.transpose();
  }
}

TEST_F(FalconDelta, JacobianGivesTheCorrectedCheckPoints) {
  const auto jacobian_at = [&](const Vec3& tool) {
    return delta_.forward(*delta_.inverse(tool), kMiddle).jacobian_D;
  };
  Mat3 expected;
  expected << 0.015488, -0.052725, 0.037237, -0.051940, 0.012557, 0.039383, 0.024180, 0.024180,
      0.024180;
  EXPECT_LT((jacobian_at({0.0, 0.0, 0.11}) - expected).cwiseAbs().maxCoeff(), 0.6e-6);
  expected << 0.016963, -0.044476, 0.041839, -0.054581, 0.011002, 0.044202, 0.020845, 0.033815,
      0.016058;
  EXPECT_LT((jacobian_at({0.02, 0.0, 0.11}) - expected).cwiseAbs().maxCoeff(), 0.6e-6);
}

TEST_F(FalconDelta, ForwardInvertsTheBisectedChain) {
  start(20261121);
  const int count = testing::share_of(2000);
  for (int i = 0; i < count; ++i) {
    const Vec3 tool = random_tool(0.05);
    const auto joints = bisected_joints(tool);
    ASSERT_TRUE(joints) << tool.transpose();
    const Pose pose = delta_.forward(*joints, kMiddle);
    ASSERT_EQ(pose.status, kPoseGood) << tool.transpose();
    EXPECT_LT((pose.p_D - tool).norm(), 1e-14) << tool.transpose();
  }
}

TEST_F(FalconDelta, InverseIsTheBisectedChain) {
  start(20261122);
  const int count = testing::share_of(2000);
  for (int i = 0; i < count; ++i) {
    const Vec3 tool = random_tool(0.055);
    const auto joints = delta_.inverse(tool);
    const auto expected = bisected_joints(tool);
    ASSERT_TRUE(joints && expected) << tool.transpose();
    EXPECT_LT((*joints - *expected).norm(), 1e-12) << tool.transpose();
  }
}

TEST_F(FalconDelta, JacobianInvertsTheDifferencesOfTheBisectedChain) {
  start(20261123);
  constexpr double kStep_m = 1e-5;
  const int count = testing::share_of(500);
  for (int i = 0; i < count; ++i) {
    const Vec3 tool = random_tool(0.045);
    Mat3 joints_by_tool;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vec3 step = kStep_m * Vec3::Unit(axis);
      joints_by_tool.col(axis) =
          (*bisected_joints(tool + step) - *bisected_joints(tool - step)) / (2.0 * kStep_m);
    }
    const Pose pose = delta_.forward(*bisected_joints(tool), kMiddle);
    const Mat3 identity = pose.jacobian_D * joints_by_tool;
    EXPECT_LT((identity - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-6) << tool.transpose();
  }
}

TEST_F(FalconDelta, PowerAtTheJointsIsThePowerAtTheTool) {
  start(20261124);
  constexpr double kStep_s = 1e-6;
  const int count = testing::share_of(500);
  for (int i = 0; i < count; ++i) {
    const Vec3 tool = random_tool(0.045);
    const Vec3 velocity(random_unit(), random_unit(), random_unit());
    const Vec3 force(8.0 * random_unit(), 8.0 * random_unit(), 8.0 * random_unit());
    const Vec3 joint_velocity = (*bisected_joints(tool + kStep_s * velocity) -
                                 *bisected_joints(tool - kStep_s * velocity)) /
                                (2.0 * kStep_s);
    const Pose pose = delta_.forward(*bisected_joints(tool), kMiddle);
    EXPECT_NEAR(joint_effort(pose, force).dot(joint_velocity), force.dot(velocity), 1e-7);
    EXPECT_LT((tool_velocity(pose, joint_velocity) - velocity).norm(), 1e-8);
  }
}

TEST_F(FalconDelta, TheAnswerDoesNotDependOnTheSeed) {
  start(20261125);
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 tool = random_tool(0.05);
    const Vec3 joints = *delta_.inverse(tool);
    const Vec3 seed(0.1 * random_unit(), 0.1 * random_unit(), 0.2 * random_unit());
    const Pose warm = delta_.forward(joints, tool + Vec3::Constant(1e-4));
    const Pose far = delta_.forward(joints, seed);
    ASSERT_EQ(warm.status, kPoseGood);
    ASSERT_EQ(far.status, kPoseGood) << tool.transpose() << " from " << seed.transpose();
    EXPECT_LT((warm.p_D - far.p_D).norm(), 1e-14);
  }
}

TEST_F(FalconDelta, PosesNearASingularityAreFlaggedAndGiveNoTorque) {
  for (const double angle_deg : {-70.0, -62.0, 95.0}) {
    const double angle = angle_deg * kDegree;
    const Pose pose = delta_.forward(Vec3::Constant(angle), kMiddle);
    EXPECT_EQ(pose.status, kPoseSingular) << angle_deg;
    EXPECT_NEAR(rod_error(105.0, angle, pose.p_D), 0.0, 1e-14);
    EXPECT_NEAR(rod_error(-15.0, angle, pose.p_D), 0.0, 1e-14);
    EXPECT_EQ(joint_effort(pose, {8.0, 8.0, 8.0}), Vec3::Zero());
  }
}

TEST_F(FalconDelta, JointsThatNoToolFitsAreFlaggedAndKeepTheSeed) {
  const Vec3 joints = Vec3(180.0, 0.0, 0.0) * kDegree;
  // A rod's error changes no faster than the tool moves, so a grid proves that nothing fits.
  constexpr double kGrid_m = 0.008;
  double least = 1.0;
  for (double x = -0.2; x <= 0.2; x += kGrid_m) {
    for (double y = -0.2; y <= 0.2; y += kGrid_m) {
      for (double z = -0.2; z <= 0.2; z += kGrid_m) {
        const Vec3 tool(x, y, z);
        least = std::min(least, std::max({std::abs(rod_error(105.0, joints.x(), tool)),
                                          std::abs(rod_error(-15.0, joints.y(), tool)),
                                          std::abs(rod_error(-135.0, joints.z(), tool))}));
      }
    }
  }
  EXPECT_GT(least, kGrid_m * std::sqrt(3.0) / 2.0);

  const Pose pose = delta_.forward(joints, kMiddle);
  EXPECT_EQ(pose.status, kPoseNotConverged);
  EXPECT_EQ(pose.p_D, kMiddle);
  EXPECT_EQ(pose.jacobian_D, Mat3::Zero());
}

TEST_F(FalconDelta, AnyJointsGiveAFinitePoseAndBoundedTorques) {
  start(20261126);
  for (int i = 0; i < testing::share_of(50'000); ++i) {
    const Vec3 joints = std::numbers::pi * Vec3(random_unit(), random_unit(), random_unit());
    const Pose pose = delta_.forward(joints, random_tool(0.05));
    EXPECT_TRUE(pose.p_D.allFinite());
    EXPECT_LT(pose.jacobian_D.cwiseAbs().maxCoeff(), 0.06 / 0.1) << joints.transpose();
  }
}

TEST_F(FalconDelta, InverseIsEmptyOutOfReach) {
  EXPECT_FALSE(delta_.inverse({0.0, 0.0, 0.05}));
  EXPECT_FALSE(delta_.inverse({0.0, 0.0, 0.19}));
  EXPECT_FALSE(delta_.inverse({0.3, 0.0, 0.12}));
}

}  // namespace
}  // namespace tactus::firmware
