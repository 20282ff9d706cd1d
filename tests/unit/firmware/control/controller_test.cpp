#include "firmware/control/controller.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "firmware/safety/faults.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr rendering::Material kRubber = {
    .stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}};

drivers::JointSample at(double x, double y, double z) {
  drivers::JointSample sample;
  sample.position = {x, y, z};
  return sample;
}

const drivers::JointSample kAbove = at(0.01, 0.05, 0.02);
// The proxy stands off by the contact skin, below 1 um: below 0.5 mN.
constexpr double kSkin_m = 1e-6;
constexpr double kSkinForce_N = 500.0 * kSkin_m;

const drivers::JointSample kPressed = at(0.01, -0.004, 0.02);  // 4 mm deep: 2 N

bool is_zero(const drivers::JointCommand& command) {
  return !command.enable && command.effort == std::array<double, drivers::kMaxJoints>{};
}

std::uint64_t g_ticks_of_clock = 0;
std::uint64_t ticking_clock() {
  return g_ticks_of_clock += 10;
}

// The samples of these tests are where they are needed, without a way between them.
ControllerConfig teleporting_config() {
  ControllerConfig config = cartesian_config();
  config.safety.max_joint_speed = 1e6;
  return config;
}

// A Cartesian device over the floor at y = 0.
class ControllerTest : public ::testing::Test {
 protected:
  ControllerTest() {
    EXPECT_TRUE(controller_.configure(teleporting_config()));
    EXPECT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  // Leaves the controller active and at rest, above the floor.
  void activate() {
    controller_.tick(kAbove, Request::home);
    controller_.tick(kAbove, Request::none);
    controller_.tick(kAbove, Request::enable);
    ASSERT_EQ(controller_.mode(), Mode::active);
  }

  void press_until_steady() {
    activate();
    for (int tick = 0; tick < 1000; ++tick) {
      controller_.tick(kAbove, Request::none);
    }
    for (int tick = 0; tick < 100; ++tick) {
      last_ = controller_.tick(kPressed, Request::none);
    }
    ASSERT_NEAR(last_.effort[1], 2.0, kSkinForce_N);
    ASSERT_EQ(controller_.record().limits, 0U);
  }

  Floor floor_{kRubber};
  Controller controller_;
  drivers::JointCommand last_;
};

TEST_F(ControllerTest, PressingOnTheFloorPushesBackAsHookeSays) {
  press_until_steady();
  EXPECT_TRUE(last_.enable);
  const TelemetryRecord& record = controller_.record();
  EXPECT_EQ(record.mode, Mode::active);
  EXPECT_EQ(record.contact, rendering::ContactKind::face);
  EXPECT_NEAR(record.depth_m, 0.004, kSkin_m);
  EXPECT_NEAR(record.proxy_W[1], 0.0, kSkin_m);
  EXPECT_NEAR(record.force_rendered_W[1], 2.0, kSkinForce_N);
  EXPECT_EQ(record.force_commanded_W, record.force_rendered_W);
  EXPECT_EQ(record.normal_W, (Triple{0.0, 1.0, 0.0}));
  EXPECT_EQ(record.tool_p_W, (Triple{0.01, -0.004, 0.02}));
  EXPECT_EQ(record.joint_position, kPressed.position);
  EXPECT_EQ(record.joint_effort, last_.effort);
}

TEST_F(ControllerTest, OnlyActiveEnablesTheMotors) {
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::none)));
  EXPECT_EQ(controller_.mode(), Mode::init);
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::enable)));
  EXPECT_EQ(controller_.mode(), Mode::init);
  EXPECT_TRUE(is_zero(controller_.tick(kAbove, Request::home)));
  EXPECT_EQ(controller_.mode(), Mode::homing);
  EXPECT_TRUE(is_zero(controller_.tick(kAbove, Request::none)));
  EXPECT_EQ(controller_.mode(), Mode::ready);
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::none)));
  EXPECT_TRUE(controller_.tick(kPressed, Request::enable).enable);
  EXPECT_EQ(controller_.mode(), Mode::active);
  EXPECT_TRUE(is_zero(controller_.tick(kPressed, Request::disable)));
  EXPECT_EQ(controller_.mode(), Mode::ready);
}

TEST_F(ControllerTest, HomingWaitsForTheDevice) {
  drivers::JointSample homing = at(7.0, 7.0, 7.0);
  homing.status = drivers::kDeviceHoming;
  controller_.tick(homing, Request::home);
  for (int tick = 0; tick < 10; ++tick) {
    EXPECT_TRUE(is_zero(controller_.tick(homing, Request::enable)));
    EXPECT_EQ(controller_.mode(), Mode::homing);
  }
  controller_.tick(kAbove, Request::none);
  EXPECT_EQ(controller_.mode(), Mode::ready);
  homing.status = drivers::kDeviceNotReady;
  controller_.tick(homing, Request::none);
  EXPECT_EQ(controller_.mode(), Mode::init);
  EXPECT_EQ(controller_.record().faults, 0U);
}

TEST_F(ControllerTest, ActivationWhilePressedStartsFromZeroAndFollowsTheRamps) {
  controller_.tick(kAbove, Request::home);
  controller_.tick(kAbove, Request::none);
  controller_.tick(kPressed, Request::none);
  EXPECT_NEAR(controller_.record().force_rendered_W[1], 2.0, kSkinForce_N);
  const SafetyConfig& safety = controller_.config().safety;
  for (int tick = 0; tick < 600; ++tick) {
    const auto request = tick == 0 ? Request::enable : Request::none;
    const double effort = controller_.tick(kPressed, request).effort[1];
    const double rendered = controller_.record().force_rendered_W[1];
    const double gain = std::min(1.0, tick / (1000.0 * safety.soft_start_s)) *
                        std::min(1.0, tick / (1000.0 * safety.contact_start_s));
    EXPECT_NEAR(effort, gain * rendered, 1e-9) << tick;
    EXPECT_EQ((controller_.record().limits & kLimitSoftStart) != 0, gain < 1.0 - 1e-9) << tick;
  }
}

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
    ASSERT_TRUE(controller_.configure(cartesian_config()));
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
    ASSERT_TRUE(controller_.configure(cartesian_config()));
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
  bad.position[2] = kNaN;
  EXPECT_TRUE(is_zero(controller_.tick(bad, Request::none)));
  EXPECT_EQ(controller_.record().faults, kFaultJointNotFinite);
  EXPECT_EQ(controller_.record().tool_p_W, (Triple{0.01, -0.004, 0.02}));
  EXPECT_EQ(controller_.record().tool_v_W, (Triple{}));
}

TEST_F(ControllerTest, AVelocityThatOverflowsInTheFilterStops) {
  ControllerConfig config = cartesian_config();
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
  ControllerConfig config = cartesian_config();
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

TEST_F(ControllerTest, AJumpOfTheToolGivesNoMoreThanTheClamp) {
  ControllerConfig config = cartesian_config();
  for (JointLimits& joint : config.joints) {
    joint.lower = -10.0;
    joint.upper = 10.0;
  }
  config.safety.force_slew_N_per_s = 1e6;
  config.safety.max_joint_speed = 1e6;
  ASSERT_TRUE(controller_.configure(config));
  activate();
  for (int tick = 0; tick < 1000; ++tick) {
    controller_.tick(kPressed, Request::none);
  }
  const drivers::JointCommand command = controller_.tick(at(0.01, -9.0, 0.02), Request::none);
  EXPECT_DOUBLE_EQ(command.effort[1], config.safety.max_force_N);
  EXPECT_EQ(controller_.record().limits, kLimitForce);
}

TEST_F(ControllerTest, TheEffortLimitScalesTheWholeForce) {
  ControllerConfig config = cartesian_config();
  config.joints[1].max_effort = 0.5;
  config.safety.blocked_s = 60.0;
  ASSERT_TRUE(controller_.configure(config));
  activate();
  for (int tick = 0; tick < 1000; ++tick) {
    controller_.tick(kPressed, Request::none);
  }
  EXPECT_DOUBLE_EQ(controller_.record().joint_effort[1], 0.5);
  EXPECT_DOUBLE_EQ(controller_.record().force_commanded_W[1], 0.5);
  EXPECT_EQ(controller_.record().limits & kLimitEffort, kLimitEffort);
}

TEST_F(ControllerTest, AFalconPoseNearASingularityStops) {
  ControllerConfig config = falcon_config();
  for (JointLimits& joint : config.joints) {
    joint.lower = -3.2;
    joint.upper = 3.2;
  }
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

TEST_F(ControllerTest, TheFalconsWorldOriginIsTheMiddleOfItsWorkspace) {
  ASSERT_TRUE(controller_.configure(falcon_config()));
  const Vec3 joints = *Delta{DeltaGeometry{}}.inverse({0.01, -0.015, 0.12});
  const drivers::JointSample sample = at(joints.x(), joints.y(), joints.z());
  controller_.tick(sample, Request::home);
  controller_.tick(sample, Request::none);
  EXPECT_NEAR(controller_.record().tool_p_W[0], 0.01, 1e-14);
  EXPECT_NEAR(controller_.record().tool_p_W[1], -0.015, 1e-14);
  EXPECT_NEAR(controller_.record().tool_p_W[2], 0.0, 1e-14);
}

TEST(Controller, WithoutAConfigurationEveryTickIsAFaultWithZeroEffort) {
  Controller controller;
  for (const Request request : {Request::home, Request::reset, Request::enable}) {
    EXPECT_TRUE(is_zero(controller.tick(kAbove, request)));
    EXPECT_EQ(controller.mode(), Mode::fault);
    EXPECT_EQ(controller.record().faults, kFaultNotConfigured);
  }
}

TEST_F(ControllerTest, AnInvalidConfigurationChangesNothing) {
  press_until_steady();
  ControllerConfig bad = cartesian_config();
  bad.rate_hz = 0.0;
  const auto result = controller_.configure(bad);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().field, "rate_hz");
  EXPECT_EQ(controller_.mode(), Mode::active);
  EXPECT_NEAR(controller_.tick(kPressed, Request::none).effort[1], 2.0, kSkinForce_N);
}

TEST_F(ControllerTest, ASceneIsNotSwappedWhileActive) {
  press_until_steady();
  EXPECT_FALSE(controller_.load_scene({}, {.tool_radius_m = 0.0}));
  EXPECT_NEAR(controller_.tick(kPressed, Request::none).effort[1], 2.0, kSkinForce_N);
  controller_.tick(kPressed, Request::disable);
  EXPECT_TRUE(controller_.load_scene({}, {.tool_radius_m = 0.0}));
}

TEST_F(ControllerTest, StageTimesComeFromTheClockAndStayOutOfTheHash) {
  static Controller timed;
  ASSERT_TRUE(timed.configure(cartesian_config()));
  ASSERT_TRUE(timed.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  timed.set_clock(ticking_clock);
  for (int tick = 0; tick < 50; ++tick) {
    const Request request = tick == 0 ? Request::home : tick == 2 ? Request::enable : Request::none;
    timed.tick(kPressed, request);
    controller_.tick(kPressed, request);
    EXPECT_EQ(timed.record().state_hash, controller_.record().state_hash);
    EXPECT_EQ(timed.record().stage_ns.check, 10U);
    EXPECT_EQ(timed.record().stage_ns.kinematics, 10U);
    EXPECT_EQ(timed.record().stage_ns.touch, 10U);
    EXPECT_EQ(timed.record().stage_ns.safety, 10U);
    EXPECT_EQ(controller_.record().stage_ns.touch, 0U);
  }
}

TEST_F(ControllerTest, CountersAndTimeGoIntoTheRecord) {
  activate();
  controller_.tick(kAbove, Request::estop);
  EXPECT_EQ(controller_.record().tick, 3U);
  EXPECT_DOUBLE_EQ(controller_.record().time_s, 0.003);
  EXPECT_EQ(controller_.record().request, Request::estop);
  EXPECT_EQ(controller_.record().counters.faults_entered, 1U);
}

}  // namespace
}  // namespace tactus::firmware
