#include "firmware/kinematics/paddle.h"

#include <gtest/gtest.h>

#include <numbers>

namespace tactus::firmware {
namespace {

constexpr double kPaddleDegree = std::numbers::pi / 180.0;

// Published, as lengths of the handle's arc: 4.9513 degrees are 5.674 mm, -5.7487 are -6.588 mm.
TEST(Paddle, TheHandlesArcGivesThePublishedCheckPoints) {
  const PaddleGeometry hapkit;
  for (const auto& [angle_deg, arc_mm] : {std::pair{4.9513, 5.674}, std::pair{-5.7487, -6.588}}) {
    const Pose pose = paddle_forward(hapkit, angle_deg * kPaddleDegree);
    // The chord of that arc from the handle straight up.
    const double chord_m = (pose.p_D - Vec3(0.0, 0.065659, 0.0)).norm();
    const double arc_m = 2.0 * 0.065659 * std::asin(0.5 * chord_m / 0.065659);
    EXPECT_NEAR(std::copysign(arc_m, pose.p_D.x()) * 1e3, arc_mm, 5e-4);
    EXPECT_EQ(pose.p_D.z(), 0.0);
    EXPECT_EQ(pose.status, kPoseGood);
  }
}

TEST(Paddle, AForceAlongTheArcHasTheHandlesLeverAndOneAcrossItNone) {
  const PaddleGeometry hapkit;
  for (const double joint : {-0.7, 0.0, 0.3}) {
    const Pose pose = paddle_forward(hapkit, joint);
    const Vec3 along(std::cos(joint), -std::sin(joint), 0.0);
    const Vec3 outward(std::sin(joint), std::cos(joint), 0.0);
    EXPECT_NEAR(joint_effort(pose, along).x(), 0.065659, 1e-15);
    EXPECT_NEAR(joint_effort(pose, outward).x(), 0.0, 1e-17);
    EXPECT_EQ(joint_effort(pose, Vec3::UnitZ()), Vec3::Zero());
  }
}

TEST(Paddle, APaddleThatLeansFallsFurtherAndIsHeldBack) {
  const PaddleGeometry hapkit{.paddle = {.mass_kg = 0.02, .centre_m = 0.03}};
  const Pose leaning = paddle_forward(hapkit, std::numbers::pi / 6.0);
  EXPECT_NEAR(paddle_gravity_effort(hapkit, leaning, {0.0, -10.0, 0.0}), -0.02 * 10.0 * 0.03 * 0.5,
              1e-15);
}

TEST(Paddle, TheAxisHasNoAngle) {
  EXPECT_FALSE(paddle_inverse({0.0, 0.0, 0.05}));
  EXPECT_NEAR(*paddle_inverse({0.01, 0.01, 0.3}), 45.0 * kPaddleDegree, 1e-15);
}

}  // namespace
}  // namespace tactus::firmware
