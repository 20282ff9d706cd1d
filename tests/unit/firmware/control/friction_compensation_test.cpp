#include "firmware/control/friction_compensation.h"

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

using rendering::FrictionKind;

// Fs / sigma0 = 25 um.
constexpr rendering::FrictionParameters kModel{.kind = FrictionKind::lugre,
                                               .coulomb = 0.04,
                                               .static_level = 0.05,
                                               .viscous_s_per_m = 0.5,
                                               .stribeck_velocity_m_per_s = 0.005,
                                               .stiffness_N_per_m = 2000.0,
                                               .damping_s_per_m = 1.5};
constexpr double kShare = 0.7;
constexpr double kLevel_N = kShare * 0.04;
constexpr double kLength_m = 25e-6;

ControllerConfig compensating(double share = kShare) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.friction.fill({.model = kModel, .compensated_share = share});
  config.safety.soft_start_s = 0.0;
  return config;
}

Pose cartesian_pose() {
  Pose pose;
  pose.jacobian_D.setIdentity();
  return pose;
}

// One compensation on its own, moved along x.
class FrictionCompensationTest : public ::testing::Test {
 protected:
  void start(const ControllerConfig& config) {
    compensation_.configure(config);
    compensation_.push(Vec3::Zero(), Vec3::Zero(), room_);  // where it stands, and the soft start
  }
  double push_at(double x_m, double v_m_per_s = 0.0) {
    const FrictionPush push = compensation_.push({x_m, 0.0, 0.0}, {v_m_per_s, 0.0, 0.0}, room_);
    held_back_ = push.is_held_back;
    EXPECT_EQ(push.effort.y(), 0.0);
    return push.effort.x();
  }

  FrictionCompensation compensation_;
  Pose pose_ = cartesian_pose();
  PushRoom room_{.pose = pose_, .effort = Vec3::Zero(), .force_N = 10.0};
  bool held_back_ = false;
};

TEST_F(FrictionCompensationTest, IsOffWithoutAShare) {
  ControllerConfig config = compensating(0.0);
  compensation_.configure(config);
  EXPECT_FALSE(compensation_.is_on());
  config.friction[2].compensated_share = 0.1;
  compensation_.configure(config);
  EXPECT_TRUE(compensation_.is_on());
}

// s Fc (1 - exp(-x / l)) along the motion, and back from s Fc over the same length.
TEST_F(FrictionCompensationTest, TurnsRoundOverTheFrictionsOwnLength) {
  start(compensating());
  for (int i = 1; i <= 200; ++i) {
    const double x_m = 1e-6 * i;
    ASSERT_NEAR(push_at(x_m), kLevel_N * (1.0 - std::exp(-x_m / kLength_m)), 1e-12);
  }
  const double top_N = push_at(200e-6);
  for (int i = 1; i <= 200; ++i) {
    const double back_m = 1e-6 * i;
    ASSERT_NEAR(push_at(200e-6 - back_m),
                -kLevel_N + (top_N + kLevel_N) * std::exp(-back_m / kLength_m), 1e-12);
  }
}

TEST_F(FrictionCompensationTest, HasNoStribeckHump) {
  start(compensating());
  const double slow_m_per_s = 1e-4;  // where the friction itself is nearly 0.05 N
  double x_m = 0.0;
  for (int tick = 0; tick < 10000; ++tick) {
    x_m += 1e-3 * slow_m_per_s;
    ASSERT_LE(push_at(x_m, slow_m_per_s), kLevel_N + kShare * 0.5 * slow_m_per_s + 1e-15);
  }
}

TEST_F(FrictionCompensationTest, GivesTheShareOfTheViscousFrictionBack) {
  start(compensating());
  EXPECT_NEAR(push_at(0.01, 0.2) - push_at(0.02, 0.0), kShare * 0.5 * 0.2, 1e-12);
}

TEST_F(FrictionCompensationTest, TakesTheLongerOfTheTwoLengths) {
  ControllerConfig config = compensating();
  config.friction[0].turn_length = 1e-4;
  start(config);
  EXPECT_NEAR(push_at(1e-4), kLevel_N * (1.0 - std::exp(-1.0)), 1e-12);
  config.friction[0].turn_length = 1e-6;
  start(config);
  EXPECT_NEAR(push_at(kLength_m), kLevel_N * (1.0 - std::exp(-1.0)), 1e-12);
}

// A rigid model has no length of its own.
TEST_F(FrictionCompensationTest, TurnsRoundOverTheGivenLengthWhereTheModelIsRigid) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.safety.soft_start_s = 0.0;
  config.friction[0] = {.model = {.kind = FrictionKind::coulomb_viscous, .coulomb = 0.04},
                        .compensated_share = kShare,
                        .turn_length = 50e-6};
  start(config);
  EXPECT_NEAR(push_at(50e-6), kLevel_N * (1.0 - std::exp(-1.0)), 1e-12);
}

// An encoder at rest on the edge of a count of 5 um, and the slope of the bristle.
TEST_F(FrictionCompensationTest, DoesNotChatterWithTheEncoder) {
  start(compensating());
  constexpr double kCount_m = 5e-6;
  double last_N = push_at(kCount_m);
  for (int tick = 0; tick < 1000; ++tick) {
    const double now_N = push_at(tick % 2 == 0 ? 0.0 : kCount_m);
    ASSERT_LE(std::abs(now_N - last_N), kLevel_N * kCount_m / kLength_m * 1.2);
    last_N = now_N;
  }
}

TEST_F(FrictionCompensationTest, StaysWithinAJointsEffort) {
  start(compensating());
  room_.effort = {cartesian_config().joints[0].max_effort - 0.01, 0.0, 0.0};
  EXPECT_NEAR(push_at(1e-3), 0.01, 1e-12);
  EXPECT_TRUE(held_back_);
  room_.effort.x() = cartesian_config().joints[0].max_effort;
  EXPECT_NEAR(push_at(2e-3), 0.0, 1e-12);
  room_.effort.x() = 0.0;
  EXPECT_NEAR(push_at(3e-3), kLevel_N, 1e-12);
  EXPECT_FALSE(held_back_);
}

TEST_F(FrictionCompensationTest, CountsAgainstTheLargestForce) {
  start(compensating());
  room_.force_N = 0.012;
  EXPECT_NEAR(push_at(1e-3), 0.012, 1e-12);
  EXPECT_TRUE(held_back_);
  pose_.jacobian_D(0, 0) = 0.5;  // half the lever, twice the force
  EXPECT_NEAR(push_at(2e-3), 0.006, 1e-12);
  room_.force_N = 0.0;
  EXPECT_EQ(push_at(3e-3), 0.0);
}

TEST_F(FrictionCompensationTest, RisesWithTheSoftStart) {
  ControllerConfig config = compensating();
  config.safety.soft_start_s = 0.1;  // 100 ticks
  compensation_.configure(config);
  for (int tick = 0; tick < 150; ++tick) {
    ASSERT_NEAR(push_at(1e-3 * tick), tick == 0 ? 0.0 : kLevel_N * std::min(1.0, 0.01 * tick),
                1e-12);
  }
  compensation_.rest();
  EXPECT_EQ(push_at(1.0), 0.0);
}

// The compensation in the controller, over a floor.
class CompensatingController : public ::testing::Test {
 protected:
  static std::unique_ptr<Controller> active(const ControllerConfig& config, const Floor& floor) {
    auto controller = std::make_unique<Controller>();
    EXPECT_TRUE(controller->configure(config));
    EXPECT_TRUE(controller->load_scene(floor.objects(), {.tool_radius_m = 0.0}));
    controller->tick(moving(0), Request::home);
    controller->tick(moving(0), Request::none);
    controller->tick(moving(0), Request::enable);
    EXPECT_EQ(controller->mode(), Mode::active);
    return controller;
  }

  // Returns the sample of a tool that moves to and fro along x and down into the floor.
  static drivers::JointSample moving(int tick) {
    drivers::JointSample sample;
    const double t_s = 1e-3 * tick;
    sample.position = {0.02 * std::sin(7.0 * t_s), 0.003 * std::cos(3.0 * t_s), 0.0};
    sample.velocity = {0.14 * std::cos(7.0 * t_s), -0.009 * std::sin(3.0 * t_s), 0.0};
    return sample;
  }

  Floor floor_{{.stiffness_N_per_m = 500.0, .friction = rendering::cone_friction(0.5, 0.3)}};
};

TEST_F(CompensatingController, IsTheSameToTheBitWithoutAShare) {
  const auto plain = active(testing::without_sign_check(cartesian_config()), floor_);
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.friction.fill({.model = kModel, .compensated_share = 0.0, .turn_length = 1e-3});
  const auto off = active(config, floor_);
  for (int tick = 1; tick < 3000; ++tick) {
    const drivers::JointCommand command = off->tick(moving(tick), Request::none);
    ASSERT_EQ(command.effort, plain->tick(moving(tick), Request::none).effort);
    ASSERT_EQ(off->record().state_hash, plain->record().state_hash);
    ASSERT_EQ(off->record().joint_compensation, TelemetryRecord{}.joint_compensation);
  }
}

TEST_F(CompensatingController, AddsItsPushToTheEffortsAndNothingElse) {
  ControllerConfig config = compensating();
  const auto with = active(config, floor_);
  config.friction = {};
  const auto without = active(config, floor_);
  double largest_N = 0.0;
  for (int tick = 1; tick < 3000; ++tick) {
    const drivers::JointCommand command = with->tick(moving(tick), Request::none);
    const drivers::JointCommand plain = without->tick(moving(tick), Request::none);
    const TelemetryRecord& record = with->record();
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      ASSERT_DOUBLE_EQ(command.effort[joint],
                       plain.effort[joint] + record.joint_compensation[joint]);
      ASSERT_LE(std::abs(record.joint_compensation[joint]),
                kLevel_N + kShare * 0.5 * std::abs(record.joint_velocity[joint]) + 1e-15);
      largest_N = std::max(largest_N, std::abs(record.joint_compensation[joint]));
    }
    ASSERT_EQ(record.force_commanded_W, without->record().force_commanded_W);
  }
  EXPECT_GT(largest_N, kLevel_N);
}

TEST_F(CompensatingController, IsZeroInEveryModeButActiveAndStartsAgainFromNone) {
  const auto controller = active(compensating(), floor_);
  for (int tick = 1; tick < 300; ++tick) {
    controller->tick(moving(tick), Request::none);
  }
  ASSERT_NE(controller->record().joint_compensation[0], 0.0);
  const auto expect_none = [&](const drivers::JointSample& sample, Request request) {
    const drivers::JointCommand command = controller->tick(sample, request);
    EXPECT_FALSE(command.enable);
    EXPECT_EQ(command.effort, drivers::JointCommand{}.effort);
    EXPECT_EQ(controller->record().joint_compensation, TelemetryRecord{}.joint_compensation);
  };
  drivers::JointSample broken = moving(300);
  broken.position[0] = std::numeric_limits<double>::quiet_NaN();
  expect_none(broken, Request::none);
  ASSERT_EQ(controller->mode(), Mode::fault);
  expect_none(moving(301), Request::none);
  expect_none(moving(302), Request::reset);
  ASSERT_EQ(controller->mode(), Mode::init);
  expect_none(moving(303), Request::home);
  controller->tick(moving(304), Request::none);
  controller->tick(moving(305), Request::enable);
  ASSERT_EQ(controller->mode(), Mode::active);
  EXPECT_EQ(controller->record().joint_compensation[0], 0.0) << "the soft start begins";
  controller->tick(moving(306), Request::none);
  EXPECT_NE(controller->record().joint_compensation[0], 0.0);
  controller->tick(moving(307), Request::disable);
  expect_none(moving(308), Request::none);
}

TEST_F(CompensatingController, SaysThatALimitHoldsItBack) {
  ControllerConfig config = compensating();
  config.safety.max_force_N = 0.01;
  const auto controller = active(config, floor_);
  for (int tick = 1; tick < 300; ++tick) {
    controller->tick(moving(tick), Request::none);
  }
  EXPECT_NE(controller->record().limits & kLimitCompensation, 0U);
  EXPECT_NE(controller->mode(), Mode::fault);
}

TEST_F(CompensatingController, StopsWhereAPushWouldNotBeFinite) {
  ControllerConfig config = compensating();
  config.friction[0].model.viscous_s_per_m = 1000.0;
  config.safety.guards_off = kFaultOverspeed | kFaultEncoderJump | kFaultMotionWithoutTorque;
  const auto controller = active(config, floor_);
  const auto pressing = [](int tick) {
    drivers::JointSample sample = moving(tick);
    sample.position[1] = -0.002;
    return sample;
  };
  for (int tick = 1; tick < 700; ++tick) {
    controller->tick(pressing(tick), Request::none);
  }
  ASSERT_GT(controller->record().force_commanded_W[1], 0.1);
  drivers::JointSample fast = pressing(700);
  fast.velocity[0] = 1e308;
  EXPECT_FALSE(controller->tick(fast, Request::none).enable);
  EXPECT_NE(controller->record().faults & kFaultCommandNotFinite, 0U);
  EXPECT_EQ(controller->record().force_commanded_W, Triple{}) << "no motor had any";
}

}  // namespace
}  // namespace tactus::firmware
