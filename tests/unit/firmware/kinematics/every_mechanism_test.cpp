// Properties of every mechanism, at random joints within its preset's limits.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>

#include "firmware/configuration/controller_config.h"
#include "tests/support/share.h"
#include "tests/unit/firmware/kinematics/body_potential.h"
#include "tests/unit/firmware/kinematics/random_joints.h"

namespace tactus::firmware {
namespace {

class EveryMechanism : public ::testing::TestWithParam<std::string_view> {
 protected:
  // Returns joints that give a good pose.
  Vec3 good_joints() {
    while (true) {
      const Vec3 joints = random_.within(config_);
      if (forward(joints).status == kPoseGood) {
        return joints;
      }
    }
  }

  [[nodiscard]] Pose forward(const Vec3& joints) const {
    return mechanism_.forward(joints, config_.workspace_origin_D);
  }

  // Returns the joints by the mechanism's closed form.
  [[nodiscard]] std::optional<Vec3> inverse(const Vec3& p_D, const Vec3& near) const {
    if (const auto* delta = std::get_if<DeltaGeometry>(&config_.mechanism)) {
      return Delta(*delta).inverse(p_D);
    }
    if (std::holds_alternative<PaddleGeometry>(config_.mechanism)) {
      return Vec3(*paddle_inverse(p_D), 0.0, 0.0);
    }
    if (const auto* pantograph = std::get_if<PantographGeometry>(&config_.mechanism)) {
      const auto joints = Pantograph(*pantograph).inverse(p_D);
      return joints ? std::optional<Vec3>({(*joints)[0], (*joints)[1], 0.0}) : std::nullopt;
    }
    if (const auto* arm = std::get_if<SerialArmGeometry>(&config_.mechanism)) {
      return SerialArm(*arm).inverse(p_D, near);
    }
    return p_D;
  }

  [[nodiscard]] Eigen::Index joints() const {
    return static_cast<Eigen::Index>(joint_count(config_.mechanism));
  }

  const ControllerConfig config_ = *preset_config(GetParam());
  const Mechanism mechanism_{config_.mechanism};
  RandomJoints random_{20261122};
};

TEST_P(EveryMechanism, ForwardThenInverseThenForwardIsWithinAMillionthOfAMillimetre) {
  double worst_m = 0.0;
  double worst_rad = 0.0;
  for (int i = 0; i < testing::share_of(100'000); ++i) {
    const Vec3 joints = good_joints();
    const Pose there = forward(joints);
    const auto back = inverse(there.p_D, joints + 0.01 * random_.vector());
    ASSERT_TRUE(back) << joints.transpose();
    const Pose again = mechanism_.forward(*back, there.p_D);
    ASSERT_EQ(again.status, kPoseGood) << joints.transpose();
    worst_m = std::max(worst_m, (again.p_D - there.p_D).norm());
    worst_rad = std::max(worst_rad, (*back - joints).norm());
  }
  std::printf("%.*s: %.1e m, joints within %.1e\n", static_cast<int>(GetParam().size()),
              GetParam().data(), worst_m, worst_rad);
  EXPECT_LT(worst_m, 1e-9);
  EXPECT_LT(worst_rad, 1e-9);
}

TEST_P(EveryMechanism, TheJacobianIsTheSlopeOfTheToolByTheJoints) {
  constexpr double kStep = 1e-5;
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 joints = good_joints();
    const Pose pose = forward(joints);
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Vec3 step = kStep * Vec3::Unit(j);
      const Pose ahead = forward(joints + step);
      const Pose behind = forward(joints - step);
      if (j >= this->joints()) {
        ASSERT_EQ(pose.jacobian_D.col(j), Vec3::Zero());
        ASSERT_EQ(ahead.p_D, pose.p_D);
      } else {
        const Vec3 slope = (ahead.p_D - behind.p_D) / (2.0 * kStep);
        ASSERT_LT((pose.jacobian_D.col(j) - slope).norm(), 1e-6 * (0.1 + slope.norm()))
            << joints.transpose();
      }
    }
  }
}

TEST_P(EveryMechanism, PowerAtTheJointsIsThePowerAtTheTool) {
  constexpr double kStep_s = 1e-5;
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 joints = good_joints();
    const Pose pose = forward(joints);
    const Vec3 rate = random_.vector();
    const Vec3 force = 8.0 * random_.vector();
    const Vec3 velocity =
        (forward(joints + kStep_s * rate).p_D - forward(joints - kStep_s * rate).p_D) /
        (2.0 * kStep_s);
    ASSERT_NEAR(joint_effort(pose, force).dot(rate), force.dot(velocity), 2e-6)
        << joints.transpose();
    ASSERT_LT((tool_velocity(pose, rate) - velocity).norm(), 1e-6) << joints.transpose();
  }
}

// The force that the efforts of a force are is that force, but for what is across the manifold.
TEST_P(EveryMechanism, AForceAcrossWhatTheToolMovesOnHasNoEffortAndTheRestComesBack) {
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Pose pose = forward(good_joints());
    const Vec3 force = 8.0 * random_.vector();
    const Vec3 felt = tool_force(pose, joint_effort(pose, force), joint_count(config_.mechanism));
    const Vec3 across = force - felt;
    ASSERT_LT(joint_effort(pose, across).norm(), 1e-12);
    ASSERT_NEAR(felt.dot(across), 0.0, 1e-9);
    if (joints() == 3) {
      ASSERT_LT(across.norm(), 1e-9);
    } else {
      ASSERT_LE(felt.norm(), force.norm() * (1.0 + 1e-12));
    }
  }
}

// Far beyond every limit, too: whatever the joints are, no effort grows without bound.
TEST_P(EveryMechanism, AnyJointsGiveAFinitePoseAndBoundedEfforts) {
  for (int i = 0; i < testing::share_of(100'000); ++i) {
    const Pose pose = forward(3.2 * random_.vector());
    ASSERT_TRUE(pose.p_D.allFinite());
    ASSERT_LE(pose.jacobian_D.cwiseAbs().maxCoeff(), 1.0);
    if (pose.status != kPoseGood) {
      ASSERT_EQ(joint_effort(pose, {8.0, -8.0, 8.0}), Vec3::Zero());
    }
  }
}

MechanismGeometry with_weights(MechanismGeometry geometry) {
  const LinkWeight light{.mass_kg = 0.07, .centre_m = 0.02};
  const LinkWeight heavy{.mass_kg = 0.31, .centre_m = -0.04};
  if (auto* cartesian = std::get_if<CartesianGeometry>(&geometry)) {
    cartesian->carried_kg = {0.3, 0.2, 0.1};
  } else if (auto* delta = std::get_if<DeltaGeometry>(&geometry)) {
    delta->arm = light;
    delta->rods_kg = 0.03;
    delta->platform_kg = 0.11;
  } else if (auto* paddle = std::get_if<PaddleGeometry>(&geometry)) {
    paddle->paddle = light;
  } else if (auto* pantograph = std::get_if<PantographGeometry>(&geometry)) {
    pantograph->proximal = heavy;
    pantograph->distal = light;
    pantograph->tool_kg = 0.05;
  } else if (auto* arm = std::get_if<SerialArmGeometry>(&geometry)) {
    arm->upper = heavy;
    arm->forearm = light;
    arm->tool_kg = 0.05;
  }
  return geometry;
}

TEST_P(EveryMechanism, TheGravityEffortIsTheSlopeOfTheBodiesPotential) {
  constexpr double kStep = 1e-5;
  const MechanismGeometry geometry = with_weights(config_.mechanism);
  const Mechanism weighted{geometry};
  EXPECT_TRUE(has_weight(geometry));
  for (int i = 0; i < testing::share_of(20'000); ++i) {
    const Vec3 joints = good_joints();
    const Vec3 gravity_D = 9.81 * random_.vector();
    const auto potential = [&](const Vec3& at) {
      return body_potential(geometry, at, forward(at).p_D, gravity_D);
    };
    const Vec3 effort = weighted.gravity_effort(joints, forward(joints), gravity_D);
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Vec3 step = kStep * Vec3::Unit(j);
      const double slope = (potential(joints + step) - potential(joints - step)) / (2.0 * kStep);
      ASSERT_NEAR(effort[j], slope, 1e-6) << "joint " << j << " at " << joints.transpose();
    }
  }
}

TEST_P(EveryMechanism, WithoutGravityOrWeightsNothingHasToBeHeld) {
  const Mechanism weighted{with_weights(config_.mechanism)};
  const Vec3 joints = good_joints();
  EXPECT_EQ(weighted.gravity_effort(joints, forward(joints), Vec3::Zero()), Vec3::Zero());
  if (!has_weight(config_.mechanism)) {
    EXPECT_EQ(mechanism_.gravity_effort(joints, forward(joints), {1.0, -9.81, 2.0}), Vec3::Zero());
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryMechanism, ::testing::ValuesIn(kPresetNames),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace tactus::firmware
