#include "firmware/control/gravity_compensation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

constexpr double kG = rendering::kStandardGravity_m_per_s2;

// Cartesian axes that carry 0.1, 0.2 and 0.3 kg: only y is held up, with 0.2 g.
ControllerConfig carrying() {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.mechanism = CartesianGeometry{.carried_kg = {0.1, 0.2, 0.3}};
  return config;
}

Pose pose_at(const Vec3& joints) {
  return cartesian_forward(joints);
}

TEST(GravityCompensation, IsOffWithoutWeightsAndWithoutGravity) {
  GravityCompensation compensation;
  for (const std::string_view name : kPresetNames) {
    compensation.configure(*preset_config(name));
    EXPECT_EQ(compensation.is_on(), name == "woodenhaptics") << name;
  }
  ControllerConfig config = carrying();
  compensation.configure(config);
  EXPECT_TRUE(compensation.is_on());
  config.gravity_D.setZero();
  compensation.configure(config);
  EXPECT_FALSE(compensation.is_on());
}

TEST(GravityCompensation, RisesWithTheSoftStartAndStartsAgainAfterARest) {
  ControllerConfig config = carrying();
  config.safety.soft_start_s = 0.1;  // 100 ticks
  GravityCompensation compensation;
  compensation.configure(config);
  const Mechanism mechanism{config.mechanism};
  const auto held = [&] {
    const GravityHold hold = compensation.hold(mechanism, Vec3::Zero(), pose_at(Vec3::Zero()));
    EXPECT_FALSE(hold.is_held_back);
    EXPECT_EQ(hold.effort.x(), 0.0);
    EXPECT_EQ(hold.effort.z(), 0.0);
    return hold.effort.y();
  };
  for (int tick = 0; tick < 150; ++tick) {
    ASSERT_NEAR(held(), 0.2 * kG * std::min(1.0, 0.01 * tick), 1e-12);
  }
  compensation.rest();
  EXPECT_EQ(held(), 0.0);
}

TEST(GravityCompensation, FollowsTheDirectionInWhichThingsFall) {
  ControllerConfig config = carrying();
  config.safety.soft_start_s = 0.0;
  config.gravity_D = {1.0, 2.0, -3.0};
  GravityCompensation compensation;
  compensation.configure(config);
  const Mechanism mechanism{config.mechanism};
  compensation.hold(mechanism, Vec3::Zero(), pose_at(Vec3::Zero()));
  const Vec3 effort = compensation.hold(mechanism, Vec3::Zero(), pose_at(Vec3::Zero())).effort;
  EXPECT_LT((effort - Vec3(-0.1, -0.4, 0.9)).norm(), 1e-15);
}

TEST(GravityCompensation, IsCutAtAJointsLimitAndSaysSo) {
  ControllerConfig config = carrying();
  config.safety.soft_start_s = 0.0;
  config.joints[1].max_effort = 1.5;
  GravityCompensation compensation;
  compensation.configure(config);
  const Mechanism mechanism{config.mechanism};
  compensation.hold(mechanism, Vec3::Zero(), pose_at(Vec3::Zero()));
  const GravityHold hold = compensation.hold(mechanism, Vec3::Zero(), pose_at(Vec3::Zero()));
  EXPECT_EQ(hold.effort.y(), 1.5);
  EXPECT_TRUE(hold.is_held_back);
}

// The compensation in the controller, over a floor at y = 0 that pushes the tool up.
class WeightedController : public ::testing::Test {
 protected:
  static std::unique_ptr<Controller> active(const ControllerConfig& config, const Floor& floor) {
    auto controller = std::make_unique<Controller>();
    EXPECT_TRUE(controller->configure(config));
    EXPECT_TRUE(controller->load_scene(floor.objects(), {.tool_radius_m = 0.0}));
    controller->tick(dipping(0), Request::home);
    controller->tick(dipping(0), Request::none);
    controller->tick(dipping(0), Request::enable);
    EXPECT_EQ(controller->mode(), Mode::active);
    return controller;
  }

  static drivers::JointSample dipping(int tick) {
    drivers::JointSample sample;
    sample.position = {0.0, 0.004 * std::cos(0.003 * tick), 0.0};
    return sample;
  }

  Floor floor_{{.stiffness_N_per_m = 500.0, .friction = {}}};
};

TEST_F(WeightedController, AddsTheHoldToTheEffortsAndNothingElse) {
  const auto with = active(carrying(), floor_);
  const auto without = active(testing::without_sign_check(cartesian_config()), floor_);
  double most_N = 0.0;
  for (int tick = 1; tick < 3000; ++tick) {
    const drivers::JointCommand command = with->tick(dipping(tick), Request::none);
    const drivers::JointCommand plain = without->tick(dipping(tick), Request::none);
    const TelemetryRecord& record = with->record();
    ASSERT_NEAR(record.joint_gravity[1], 0.2 * kG * std::min(1.0, tick / 500.0), 1e-12);
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      ASSERT_DOUBLE_EQ(command.effort[joint], plain.effort[joint] + record.joint_gravity[joint]);
    }
    ASSERT_EQ(record.force_commanded_W, without->record().force_commanded_W);
    most_N = std::max(most_N, record.force_commanded_W[1]);
  }
  EXPECT_GT(most_N, 1.5);
}

// 0.2 g = 1.96 N of the 3 N that the joint gives leave 1.04 N to push the tool up with.
TEST_F(WeightedController, TheRenderedForceFitsIntoWhatTheHoldLeaves) {
  ControllerConfig config = carrying();
  config.joints[1].max_effort = 3.0;
  const auto controller = active(config, floor_);
  bool limited = false;
  for (int tick = 1; tick < 3000; ++tick) {
    const drivers::JointCommand command = controller->tick(dipping(tick), Request::none);
    const TelemetryRecord& record = controller->record();
    ASSERT_LE(std::abs(command.effort[1]), 3.0 * (1.0 + 1e-15));
    ASSERT_EQ(record.limits & kLimitGravity, 0U);
    if ((record.limits & kLimitEffort) != 0) {
      limited = true;
      ASSERT_NEAR(record.force_commanded_W[1], 3.0 - record.joint_gravity[1], 1e-12);
    }
  }
  EXPECT_TRUE(limited);
}

TEST_F(WeightedController, AWeightThatIsTooHeavyLeavesNoRoomAndSaysSo) {
  ControllerConfig config = carrying();
  config.joints[1].max_effort = 1.0;
  config.safety.soft_start_s = 0.0;
  const auto controller = active(config, floor_);
  for (int tick = 1; tick < 2000; ++tick) {
    const drivers::JointCommand command = controller->tick(dipping(tick), Request::none);
    ASSERT_EQ(command.effort[1], 1.0);
    ASSERT_NE(controller->record().limits & kLimitGravity, 0U);
    ASSERT_NEAR(controller->record().force_commanded_W[1], 0.0, 1e-12);
  }
}

TEST_F(WeightedController, HoldsNothingInEveryModeButActive) {
  const auto controller = active(carrying(), floor_);
  for (int tick = 1; tick < 300; ++tick) {
    controller->tick(dipping(tick), Request::none);
  }
  ASSERT_GT(controller->record().joint_gravity[1], 1.0);
  drivers::JointSample broken = dipping(300);
  broken.velocity[2] = std::numeric_limits<double>::infinity();
  for (const auto& [sample, request] :
       {std::pair{broken, Request::none}, std::pair{dipping(300), Request::none},
        std::pair{dipping(300), Request::reset}, std::pair{dipping(300), Request::home}}) {
    const drivers::JointCommand command = controller->tick(sample, request);
    EXPECT_FALSE(command.enable);
    EXPECT_EQ(command.effort, drivers::JointCommand{}.effort);
    EXPECT_EQ(controller->record().joint_gravity, TelemetryRecord{}.joint_gravity);
  }
  controller->tick(dipping(301), Request::none);
  controller->tick(dipping(302), Request::enable);
  ASSERT_EQ(controller->mode(), Mode::active);
  EXPECT_EQ(controller->record().joint_gravity[1], 0.0) << "the soft start begins";
  controller->tick(dipping(303), Request::none);
  EXPECT_NEAR(controller->record().joint_gravity[1], 0.2 * kG / 500.0, 1e-12);
}

}  // namespace
}  // namespace tactus::firmware
