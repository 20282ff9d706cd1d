#include "firmware/control/guards.h"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"

namespace tactus::firmware {
namespace {

// The guards of a Cartesian device at 1 kHz, in mode `active`.
class GuardsTest : public ::testing::Test {
 protected:
  GuardsTest() {
    guards_.configure(testing::without_sign_check(cartesian_config()));
    modes_.configure(kNoFault);
    modes_.advance(true, Request::home);
    modes_.advance(true, Request::enable);
    EXPECT_EQ(modes_.mode(), Mode::active);
    pose_.jacobian_D.setIdentity();
    check();
  }

  TickInputs inputs() const {
    return {.sample = sample_, .loop = loop_, .held = held_, .is_referenced = is_referenced_};
  }
  // Returns the FaultBits that the guards of the inputs raise.
  std::uint64_t check() {
    modes_.begin_tick();
    guards_.check_inputs(inputs(), modes_);
    return modes_.raised();
  }

  Guards guards_;
  ModeMachine modes_;
  drivers::JointSample sample_;
  LoopReport loop_;
  JointEfforts held_{};
  Pose pose_;
  bool is_referenced_ = true;
};

TEST_F(GuardsTest, EveryGuardOfTheInputsIsHeard) {
  loop_.status = kLoopWatchdogLost;
  sample_.status = drivers::kDeviceDriveFault;
  sample_.position[0] = 0.2;  // 200 m/s
  EXPECT_EQ(check(), kFaultWatchdog | kFaultDrive | kFaultEncoderJump);
}

TEST_F(GuardsTest, AJumpIsNoneWithoutAReferenceAndAfterIt) {
  is_referenced_ = false;
  sample_.position[0] = 0.2;
  EXPECT_EQ(check(), kNoFault);
  is_referenced_ = true;
  EXPECT_EQ(check(), kNoFault) << "the first position after the reference";
  sample_.position[0] = 0.0;
  EXPECT_EQ(check(), kFaultEncoderJump);
}

TEST_F(GuardsTest, MissedTicksGiveAJointTheirTime) {
  sample_.position[0] = 0.15;
  loop_.missed_ticks = 1;
  EXPECT_EQ(check() & kFaultMask, kNoFault);
}

TEST_F(GuardsTest, ASampleThatMustNotBeUsedReachesNoEncoderGuard) {
  sample_.position[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check(), kFaultJointNotFinite);
}

TEST_F(GuardsTest, TheToolAndTheMotorsAreCheckedTogether) {
  const rendering::ToolState fast{.v_W = {100.0, 0.0, 0.0}};
  const Vec3 no_force = Vec3::Zero();
  held_[1] = 5.0;
  sample_.effort_known = 0b010;
  sample_.effort_is_new = 0b010;
  sample_.effort[1] = -5.0;
  std::uint64_t seen = kNoFault;
  for (int tick = 0; tick < 100; ++tick) {
    modes_.begin_tick();
    guards_.check_tool(inputs(), {.pose = pose_, .tool = {}, .held_W = no_force}, modes_);
    seen |= modes_.raised();
  }
  EXPECT_EQ(seen, kFaultEffortMismatch);
  EXPECT_EQ(modes_.fault_joint(), 2U);
  guards_.check_tool(inputs(), {.pose = pose_, .tool = fast, .held_W = no_force}, modes_);
  EXPECT_TRUE(modes_.has_raised(kFaultOverspeed));
}

// The drive measures, late, what the motors held while no sample came.
TEST_F(GuardsTest, EffortsThatAreHeldWhileNoSampleComesCountForTheMeasurements) {
  const Vec3 no_force = Vec3::Zero();
  sample_.effort_known = 0b010;
  sample_.effort_is_new = 0b010;
  sample_.effort[1] = 5.0;
  for (int tick = 0; tick < 100; ++tick) {
    const bool is_stale = tick % 2 == 0;
    held_[1] = is_stale ? 5.0 : -5.0;
    modes_.begin_tick();
    modes_.raise(is_stale ? kLimitStaleSample : kNoFault);
    guards_.check_tool(inputs(), {.pose = pose_, .tool = {}, .held_W = no_force}, modes_);
    EXPECT_EQ(modes_.raised() & kFaultMask, kNoFault) << tick;
  }
}

TEST_F(GuardsTest, TheSignCheckIsReportedUntilAllMotorsHaveAnswered) {
  const Vec3 no_force = Vec3::Zero();
  guards_.configure(cartesian_config());
  guards_.signs.restart();
  modes_.begin_tick();
  guards_.check_tool(inputs(), {.pose = pose_, .tool = {}, .held_W = no_force}, modes_);
  EXPECT_EQ(modes_.raised(), kLimitSignCheck);
  EXPECT_NE(guards_.signs.push()[0], 0.0);
  loop_.missed_ticks = 1;
  guards_.check_tool(inputs(), {.pose = pose_, .tool = {}, .held_W = no_force}, modes_);
  modes_.raise(kLimitStaleSample);
  guards_.check_tool(inputs(), {.pose = pose_, .tool = {}, .held_W = no_force}, modes_);
  EXPECT_EQ(guards_.signs.push(), JointEfforts{}) << "a stale sample ends the pulse";
}

}  // namespace
}  // namespace tactus::firmware
