// Mechanisms with fewer than three joints in the controller: what a device reports beyond them is
// nobody's business.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

class FewJoints : public ::testing::Test {
 protected:
  // Active, with the handle 5 mm over the floor at joint 0.
  std::unique_ptr<Controller> active_paddle(ControllerConfig config) {
    config.workspace_origin_D.y() -= 0.005;
    config.safety.soft_start_s = 0.0;
    config.safety.contact_start_s = 0.0;
    auto controller = std::make_unique<Controller>();
    EXPECT_TRUE(controller->configure(config));
    EXPECT_TRUE(controller->load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
    controller->tick(paddle_at(0.0), Request::home);
    controller->tick(paddle_at(0.0), Request::none);
    controller->tick(paddle_at(0.0), Request::enable);
    EXPECT_EQ(controller->mode(), Mode::active);
    return controller;
  }

  // The second joint is broken, and there is no third.
  static drivers::JointSample paddle_at(double angle) {
    drivers::JointSample sample;
    sample.position = {angle, std::numeric_limits<double>::quiet_NaN(), 99.0};
    sample.velocity = {0.0, 1e300, std::numeric_limits<double>::infinity()};
    return sample;
  }

  Floor floor_{{.stiffness_N_per_m = 500.0, .friction = {}}};
};

TEST_F(FewJoints, JointsBeyondTheMechanismsAreNeitherReadNorRecordedNorDriven) {
  const auto controller = active_paddle(testing::without_sign_check(hapkit_config()));
  const double angle = 0.5;  // 8 mm lower: 3 mm below the floor
  drivers::JointCommand command;
  for (double joint = 0.0; joint < angle; joint += 0.001) {
    command = controller->tick(paddle_at(joint), Request::none);
    ASSERT_EQ(controller->record().faults, 0U);
  }
  const TelemetryRecord& record = controller->record();
  EXPECT_GT(record.force_commanded_W[1], 1.0);
  // Up on a handle that leans to the right: back to the left.
  EXPECT_NEAR(command.effort[0], -0.065659 * std::sin(0.5) * record.force_commanded_W[1], 1e-3);
  for (std::size_t joint = 1; joint < drivers::kMaxJoints; ++joint) {
    EXPECT_EQ(command.effort[joint], 0.0);
    EXPECT_EQ(record.joint_position[joint], 0.0);
    EXPECT_EQ(record.joint_velocity[joint], 0.0);
  }
}

TEST_F(FewJoints, FrictionIsCompensatedInTheJointsThatThereAre) {
  ControllerConfig config = testing::without_sign_check(hapkit_config());
  config.friction.fill({.model = {.kind = rendering::FrictionKind::coulomb_viscous,
                                  .coulomb = 0.006,
                                  .viscous_s_per_m = 0.001},
                        .compensated_share = 0.5,
                        .turn_length = 0.001});
  const auto controller = active_paddle(config);
  drivers::JointCommand command;
  for (double joint = 0.0; joint < 0.2; joint += 0.001) {
    command = controller->tick(paddle_at(joint), Request::none);
    ASSERT_EQ(controller->record().faults, 0U);
    ASSERT_EQ(controller->record().limits & kLimitCompensation, 0U);
  }
  EXPECT_NEAR(command.effort[0], 0.003, 1e-9);
  EXPECT_EQ(command.effort[1], 0.0);
  EXPECT_EQ(command.effort[2], 0.0);
}

TEST_F(FewJoints, APantographNearASingularityStops) {
  const auto controller = std::make_unique<Controller>();
  ControllerConfig config = testing::without_sign_check(haply_pantograph_config());
  config.joints[0].lower = config.joints[1].lower = -3.2;
  config.joints[0].upper = config.joints[1].upper = 3.2;
  config.safety.guards_off = kFaultEncoderJump | kFaultOverspeed;
  ASSERT_TRUE(controller->configure(config));
  drivers::JointSample sample;
  sample.position = {2.0, 1.1};
  controller->tick(sample, Request::home);
  controller->tick(sample, Request::none);
  controller->tick(sample, Request::enable);
  ASSERT_EQ(controller->mode(), Mode::active);
  sample.position = {1.39, 1.75};  // the elbows meet
  const drivers::JointCommand command = controller->tick(sample, Request::none);
  EXPECT_EQ(controller->record().faults, kFaultKinematicsSingular);
  EXPECT_FALSE(command.enable);
  EXPECT_EQ(command.effort, drivers::JointCommand{}.effort);
}

// The PHANToM's links lean on each other: each joint may be within its range, and their difference
// not.
TEST_F(FewJoints, TwoLinksOfAParallelogramThatMeetAreAJointLimit) {
  const auto controller = std::make_unique<Controller>();
  ControllerConfig config = testing::without_sign_check(phantom_premium_config());
  config.safety.guards_off = kFaultEncoderJump | kFaultOverspeed;
  ASSERT_TRUE(controller->configure(config));
  drivers::JointSample sample;
  sample.position = {0.0, 0.5, -0.4};
  controller->tick(sample, Request::home);
  controller->tick(sample, Request::none);
  controller->tick(sample, Request::enable);
  ASSERT_EQ(controller->mode(), Mode::active);
  sample.position[1] = -0.4 + 66.0 * std::numbers::pi / 180.0;
  controller->tick(sample, Request::none);
  EXPECT_EQ(controller->record().faults, kFaultJointLimit);
}

}  // namespace
}  // namespace tactus::firmware
