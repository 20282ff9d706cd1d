#include "firmware/kinematics/mechanism.h"

#include <gtest/gtest.h>

namespace tactus::firmware {
namespace {

TEST(Mechanism, CartesianJointsAreTheTool) {
  const Mechanism mechanism;
  const Pose pose = mechanism.forward({0.1, -0.2, 0.3}, Vec3::Zero());
  EXPECT_EQ(pose.p_D, Vec3(0.1, -0.2, 0.3));
  EXPECT_EQ(tool_velocity(pose, {1.0, 2.0, 3.0}), Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(joint_effort(pose, {4.0, 5.0, 6.0}), Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(pose.status, kPoseGood);
}

TEST(Mechanism, ADeltaGeometryMakesADelta) {
  const Mechanism mechanism{DeltaGeometry{}};
  const Pose pose =
      mechanism.forward(Vec3::Constant(35.0 * std::numbers::pi / 180.0), {0.0, 0.0, 0.12});
  EXPECT_LT((pose.p_D - Vec3(0.0, 0.0, 0.134602)).norm(), 1e-6);
}

TEST(Pose, EffortTakesTheTransposedJacobianWithoutAliasing) {
  Pose pose;
  pose.jacobian_D << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0;
  EXPECT_EQ(joint_effort(pose, {1.0, 0.0, 0.0}), Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(joint_effort(pose, {0.0, 1.0, 0.0}), Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(joint_effort(pose, {0.0, 0.0, 1.0}), Vec3(7.0, 8.0, 10.0));
}

}  // namespace
}  // namespace tactus::firmware
