#include "firmware/control/controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "firmware/safety/faults.h"
#include "rendering/tick_budget.h"
#include "tests/support/solid.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/control/controller_fixture.h"

namespace tactus::firmware {
namespace {

std::uint64_t g_ticks_of_clock = 0;
std::uint64_t ticking_clock() {
  return g_ticks_of_clock += 10;
}

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

// Homed in the middle of a potential field, given a scene with one, or both.
TEST_F(ControllerTest, AToolThatBeginsInAPotentialFieldIsNotPushedUntilItHasLeft) {
  rendering::Object field;
  field.surface = rendering::SurfaceKind::primitive;
  field.method = rendering::ContactMethod::potential_field;
  field.primitive.kind = rendering::PrimitiveKind::sphere;
  field.primitive.dimensions_m = {0.02};
  field.material = kRubber;
  for (const bool scene_is_new : {false, true}) {
    ASSERT_TRUE(controller_.configure(teleporting_config()));
    ASSERT_TRUE(controller_.load_scene({&field, 1}, {.tool_radius_m = 0.0}));
    controller_.tick(at(0.0, scene_is_new ? 0.05 : 0.01, 0.0), Request::home);
    controller_.tick(at(0.0, scene_is_new ? 0.05 : 0.01, 0.0), Request::none);
    if (scene_is_new) {
      ASSERT_TRUE(controller_.load_scene({&field, 1}, {.tool_radius_m = 0.0}));
    }
    controller_.tick(at(0.0, 0.01, 0.0), Request::none);
    controller_.tick(at(0.0, 0.01, 0.0), Request::enable);
    for (int tick = 0; tick < 1000; ++tick) {
      last_ = controller_.tick(at(0.0, 0.01 + 9e-6 * tick, 0.0), Request::none);
      ASSERT_EQ(last_.effort, (std::array<double, drivers::kMaxJoints>{})) << tick;
      ASSERT_NE(controller_.record().limits & kLimitTouch, 0U);
    }
    controller_.tick(at(0.0, 0.0201, 0.0), Request::none);
    for (int tick = 0; tick < 1000; ++tick) {
      last_ = controller_.tick(at(0.0, 0.016, 0.0), Request::none);
    }
    EXPECT_NEAR(last_.effort[1], 2.0, 1e-9);
  }
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

TEST_F(ControllerTest, OnlyHomingHomesAndOnlyAFaultTakesThePower) {
  struct Step {
    Request request;
    Mode mode;
  };
  for (const Step& step : {Step{Request::none, Mode::init}, Step{Request::home, Mode::homing},
                           Step{Request::none, Mode::ready}, Step{Request::enable, Mode::active},
                           Step{Request::disable, Mode::ready}, Step{Request::estop, Mode::fault},
                           Step{Request::none, Mode::fault}, Step{Request::reset, Mode::init}}) {
    const drivers::JointCommand command = controller_.tick(kAbove, step.request);
    ASSERT_EQ(controller_.mode(), step.mode);
    EXPECT_EQ(command.home, step.mode == Mode::homing) << mode_name(step.mode);
    EXPECT_EQ(command.power_off, step.mode == Mode::fault) << mode_name(step.mode);
  }
}

// The hand presses deeper, and so gives energy.
TEST_F(ControllerTest, AnActivationBeginsWithoutTheForceAndTheEnergyOfTheLast) {
  press_until_steady();
  for (int tick = 0; tick < 20; ++tick) {
    controller_.tick(at(0.01, -0.004 - 5e-5 * tick, 0.02), Request::none);
  }
  EXPECT_GT(controller_.record().passivity_J, 0.001);
  const drivers::JointSample deeper = at(0.01, -0.005, 0.02);
  controller_.tick(deeper, Request::disable);
  EXPECT_EQ(controller_.tick(deeper, Request::enable).effort[1], 0.0);
  EXPECT_EQ(controller_.record().passivity_J, 0.0);
  EXPECT_EQ(controller_.record().energy_J, EnergyLedger{});
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

TEST_F(ControllerTest, AJumpOfTheToolGivesNoMoreThanTheClamp) {
  ControllerConfig config = testing::without_sign_check(cartesian_config());
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
  ControllerConfig config = testing::without_sign_check(cartesian_config());
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

TEST_F(ControllerTest, TheFalconsWorldOriginIsTheMiddleOfItsWorkspace) {
  ASSERT_TRUE(controller_.configure(testing::without_sign_check(falcon_config())));
  const Vec3 joints = *Delta{DeltaGeometry{}}.inverse({0.01, -0.015, 0.12});
  const drivers::JointSample sample = at(joints.x(), joints.y(), joints.z());
  controller_.tick(sample, Request::home);
  controller_.tick(sample, Request::none);
  EXPECT_NEAR(controller_.record().tool_p_W[0], 0.01, 1e-14);
  EXPECT_NEAR(controller_.record().tool_p_W[1], -0.015, 1e-14);
  EXPECT_NEAR(controller_.record().tool_p_W[2], 0.0, 1e-14);
}

TEST_F(ControllerTest, AnInvalidConfigurationChangesNothing) {
  press_until_steady();
  ControllerConfig bad = testing::without_sign_check(cartesian_config());
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

TEST_F(ControllerTest, RefusesASceneWhoseMotionsTakeMoreThanHalfOfATick) {
  const testing::Solid sheet(testing::flat_sheet(0.002, 52), rendering::Sides::two, {});
  rendering::Object deforming = sheet.object();
  deforming.deforms = true;
  const rendering::WorldConfig scene{.tool_radius_m = 0.002};
  ControllerConfig slow = teleporting_config();
  slow.tick_instructions = 300e3;
  // The scene is there, and the budget becomes too small for it.
  ASSERT_TRUE(controller_.load_scene({&deforming, 1}, scene));
  const auto too_small = controller_.configure(slow);
  ASSERT_FALSE(too_small);
  EXPECT_EQ(too_small.error().field, "tick_instructions");
  EXPECT_GT(too_small.error().least, 300e3);
  // The other way round.
  ASSERT_TRUE(controller_.load_scene({}, scene));
  ASSERT_TRUE(controller_.configure(slow));
  const auto refused = controller_.load_scene({&deforming, 1}, scene);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().fault, SceneFault::costly);
  EXPECT_GT(rendering::instructions_of(refused.error().standing_units), 150e3);
  EXPECT_EQ(refused.error().budget_units, rendering::units_of(300e3));
  ASSERT_TRUE(controller_.load_scene({}, scene)) << "the sheet ends with this test";
}

TEST_F(ControllerTest, RefusesASceneThatExceedsACapacityAndKeepsItsOwn) {
  rendering::Object ball;
  ball.surface = rendering::SurfaceKind::primitive;
  ball.primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.01}};
  ball.moves = true;
  const std::vector<rendering::Object> balls(rendering::kMaxMovers + 1, ball);
  ASSERT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  const auto refused = controller_.load_scene(balls, {.tool_radius_m = 0.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().fault, SceneFault::capacity);
  EXPECT_EQ(refused.error().exceeded.name, "movers");
  EXPECT_EQ(refused.error().exceeded.count, rendering::kMaxMovers + 1);
  EXPECT_EQ(refused.error().exceeded.limit, rendering::kMaxMovers);
  EXPECT_EQ(controller_.world().object_count(), floor_.objects().size());
}

TEST_F(ControllerTest, StageTimesComeFromTheClockAndStayOutOfTheHash) {
  static Controller timed;
  ASSERT_TRUE(timed.configure(testing::without_sign_check(cartesian_config())));
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
