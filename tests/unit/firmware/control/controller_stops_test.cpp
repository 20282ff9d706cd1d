// Everything that takes the force away, and how it comes back.
#include <gtest/gtest.h>

#include <limits>

#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/control/controller_fixture.h"

namespace tactus::firmware {
namespace {

TEST_F(ControllerTest, EveryDeviceTroubleStopsInTheSameTick) {
  struct Trouble {
    std::uint32_t status;
    std::uint32_t fault;
  };
  for (const Trouble& trouble : {Trouble{drivers::kDeviceNotReady, kFaultReferenceLost},
                                 Trouble{drivers::kDeviceHoming, kFaultReferenceLost},
                                 Trouble{drivers::kDeviceEncoderFault, kFaultEncoder},
                                 Trouble{drivers::kDeviceDriveFault, kFaultDrive},
                                 Trouble{drivers::kDeviceEmergencyStop, kFaultEmergencyStop},
                                 Trouble{drivers::kDeviceLost, kFaultDeviceLost}}) {
    ASSERT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config())));
    press_until_steady();
    drivers::JointSample sample = kPressed;
    sample.status = trouble.status;
    EXPECT_TRUE(is_zero(controller_.tick(sample, Request::none)));
    EXPECT_EQ(controller_.mode(), Mode::fault);
    EXPECT_EQ(controller_.record().faults, trouble.fault);
    EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::enable)));
    EXPECT_EQ(controller_.record().faults, trouble.fault) << "a fault stays latched";
  }
}

TEST_F(ControllerTest, TheThirdStaleSampleStopsAndTwoDoNot) {
  press_until_steady();
  drivers::JointSample stale = kPressed;
  stale.status = drivers::kDeviceStale;
  for (int tick = 0; tick < 2; ++tick) {
    EXPECT_NEAR(controller_.tick(stale, Request::none).effort[1], 2.0, kSkinForce_N);
    EXPECT_EQ(controller_.record().limits, kLimitStaleSample);
  }
  EXPECT_TRUE(is_zero(controller_.tick(stale, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultStaleSamples);
  EXPECT_EQ(controller_.record().counters.stale_samples, 3U);
}

TEST_F(ControllerTest, TroubleReportedByTheWriteStopsTheNextTick) {
  press_until_steady();
  controller_.note_transfers(drivers::kDeviceLost, 0, 0);
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultDeviceLost);
  EXPECT_EQ(controller_.record().device_status, drivers::kDeviceLost);
}

TEST_F(ControllerTest, AnEmergencyStopRequestStopsInEveryMode) {
  for (const Mode mode : {Mode::init, Mode::homing, Mode::ready, Mode::active, Mode::fault}) {
    ASSERT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config())));
    drivers::JointSample homing = kAbove;
    homing.status = drivers::kDeviceHoming;
    if (mode == Mode::homing) {
      controller_.tick(homing, Request::home);
    } else if (mode != Mode::init) {
      activate();
      controller_.tick(kAbove, mode == Mode::ready   ? Request::disable
                               : mode == Mode::fault ? Request::estop
                                                     : Request::none);
    }
    ASSERT_EQ(controller_.mode(), mode);
    EXPECT_TRUE(
        is_zero(controller_.tick(mode == Mode::homing ? homing : kPressed, Request::estop)));
    EXPECT_EQ(controller_.mode(), Mode::fault);
    EXPECT_EQ(controller_.record().faults, kFaultOperatorStop);
  }
}

TEST_F(ControllerTest, ResetNeedsHealthyInputsAndNeverLeadsStraightBackToForce) {
  press_until_steady();
  drivers::JointSample stopped = kPressed;
  stopped.status = drivers::kDeviceEmergencyStop;
  controller_.tick(stopped, Request::none);
  controller_.tick(stopped, Request::reset);
  EXPECT_EQ(controller_.mode(), Mode::fault);
  controller_.tick(kPressed, Request::none);
  EXPECT_EQ(controller_.mode(), Mode::fault) << "releasing the stop alone does nothing";
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::reset)));
  EXPECT_EQ(controller_.mode(), Mode::init);
  EXPECT_EQ(controller_.record().faults, 0U);
  controller_.tick(kPressed, Request::home);
  controller_.tick(kPressed, Request::none);
  EXPECT_EQ(controller_.mode(), Mode::ready);
  EXPECT_EQ(controller_.tick(kPressed, Request::enable).effort[1], 0.0);
  EXPECT_EQ(controller_.mode(), Mode::active);
  for (int tick = 0; tick < 600; ++tick) {
    EXPECT_EQ(controller_.tick(kPressed, Request::none).effort[1], 0.0)
        << "the tool was inside the floor when it was found: no contact until it has left";
  }
}

TEST_F(ControllerTest, AJointBeyondItsLimitStopsUntilItIsBackInside) {
  press_until_steady();
  EXPECT_TRUE(is_zero(controller_.tick(at(0.26, -0.004, 0.02), Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultJointLimit);
  controller_.tick(at(0.26, -0.004, 0.02), Request::reset);
  EXPECT_EQ(controller_.mode(), Mode::fault);
  controller_.tick(kAbove, Request::reset);
  EXPECT_EQ(controller_.mode(), Mode::init);
}

TEST_F(ControllerTest, ANonFiniteJointStopsAndTheToolStaysWhereItWas) {
  press_until_steady();
  drivers::JointSample bad = kPressed;
  bad.position[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_zero(controller_.tick(bad, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultJointNotFinite);
  EXPECT_EQ(controller_.record().tool_p_W, (Triple{0.01, -0.004, 0.02}));
  EXPECT_EQ(controller_.record().tool_v_W, (Triple{}));
}

TEST_F(ControllerTest, AVelocityThatOverflowsInTheFilterStops) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.velocity_cutoff_hz = 1000.0;
  config.safety.guards_off = kFaultOverspeed | kFaultMotionWithoutTorque | kFaultEncoderFrozen;
  ASSERT_TRUE(controller_.configure(config));
  activate();
  drivers::JointSample sample = kAbove;
  sample.velocity[0] = 1.7e308;
  EXPECT_TRUE(controller_.tick(sample, Request::none).enable);
  sample.velocity[0] = -1.7e308;
  EXPECT_TRUE(is_zero(controller_.tick(sample, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultToolNotFinite);
  EXPECT_TRUE(is_zero(controller_.tick(kAbove, Request::reset)));
  EXPECT_EQ(controller_.mode(), Mode::init);
}

TEST_F(ControllerTest, AForceThatOverflowsStops) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.safety.guards_off = kFaultOverspeed;
  ASSERT_TRUE(controller_.configure(config));
  Floor hard({.stiffness_N_per_m = 1000.0, .damping_Ns_per_m = 1e308, .friction = {}});
  ASSERT_TRUE(controller_.load_scene(hard.objects(), {.tool_radius_m = 0.0}));
  activate();
  drivers::JointSample fast = kPressed;
  fast.velocity[1] = -100.0;
  EXPECT_TRUE(is_zero(controller_.tick(fast, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultForceNotFinite);
  EXPECT_EQ(controller_.record().force_rendered_W, (Triple{}));
}

TEST_F(ControllerTest, AFalconPoseNearASingularityStops) {
  ControllerConfig config = testing::without_sign_check(falcon_config());
  for (JointLimits& joint : config.joints) {
    joint.lower = -3.2;
    joint.upper = 3.2;
  }
  config.safety.max_joint_speed = 1e6;
  ASSERT_TRUE(controller_.configure(config));
  const drivers::JointSample good = at(0.4, 0.4, 0.4);
  controller_.tick(good, Request::home);
  controller_.tick(good, Request::none);
  controller_.tick(good, Request::enable);
  EXPECT_EQ(controller_.mode(), Mode::active);
  EXPECT_TRUE(is_zero(controller_.tick(at(1.66, 1.66, 1.66), Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultKinematicsSingular);
  EXPECT_TRUE(is_zero(controller_.tick(at(3.14, 0.0, 0.0), Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultKinematicsSingular | kFaultKinematicsNotConverged);
}

TEST(Controller, WithoutAConfigurationEveryTickIsAFaultWithZeroEffort) {
  Controller controller;
  for (const Request request : {Request::home, Request::reset, Request::enable}) {
    EXPECT_TRUE(is_zero(controller.tick(kAbove, request)));
    EXPECT_EQ(controller.mode(), Mode::fault);
    EXPECT_EQ(controller.record().faults, kFaultNotConfigured);
  }
}

}  // namespace
}  // namespace tactus::firmware
