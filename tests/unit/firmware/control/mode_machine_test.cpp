#include "firmware/control/mode_machine.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

class ModeMachineTest : public ::testing::Test {
 protected:
  ModeMachineTest() { modes_.configure(kNoFault); }

  EnteredModes tick(Request request, bool is_referenced = true, std::uint64_t found = kNoFault) {
    modes_.begin_tick();
    modes_.raise(found);
    return modes_.advance(is_referenced, request);
  }
  void activate() {
    tick(Request::home);
    tick(Request::none);
    tick(Request::enable);
    ASSERT_EQ(modes_.mode(), Mode::active);
  }

  ModeMachine modes_;
};

TEST_F(ModeMachineTest, TellsOfTheModesWhoseEntryNeedsWork) {
  EXPECT_FALSE(tick(Request::home).ready_from_homing);
  const EnteredModes both = tick(Request::enable);
  EXPECT_TRUE(both.ready_from_homing);
  EXPECT_TRUE(both.active);
  const EnteredModes none = tick(Request::enable);
  EXPECT_FALSE(none.ready_from_homing);
  EXPECT_FALSE(none.active);
  tick(Request::disable);
  const EnteredModes again = tick(Request::enable);
  EXPECT_FALSE(again.ready_from_homing) << "ready without homing moves no zero";
  EXPECT_TRUE(again.active);
}

TEST_F(ModeMachineTest, AFaultStopsAtOnceAndStaysUntilAResetInAHealthyTick) {
  activate();
  modes_.begin_tick();
  modes_.raise(kFaultOverspeed);
  EXPECT_EQ(modes_.mode(), Mode::fault);
  EXPECT_TRUE(modes_.has_entered_fault());
  tick(Request::reset, true, kFaultWorkspace);
  EXPECT_EQ(modes_.mode(), Mode::fault);
  EXPECT_EQ(modes_.faults(), kFaultOverspeed | kFaultWorkspace);
  EXPECT_FALSE(modes_.has_entered_fault()) << "it was in fault before";
  tick(Request::reset);
  EXPECT_EQ(modes_.mode(), Mode::init);
  EXPECT_EQ(modes_.faults(), kNoFault);
}

TEST_F(ModeMachineTest, ALimitChangesNoModeAndLastsATick) {
  activate();
  modes_.raise(kLimitForce);
  EXPECT_EQ(modes_.mode(), Mode::active);
  EXPECT_TRUE(modes_.has_raised(kLimitForce | kLimitSlew));
  tick(Request::none);
  EXPECT_EQ(modes_.raised(), kNoFault);
}

TEST_F(ModeMachineTest, AForceWithoutAReferenceIsAFault) {
  activate();
  tick(Request::none, false);
  EXPECT_EQ(modes_.faults(), kFaultReferenceLost);
  tick(Request::reset, false);
  EXPECT_EQ(modes_.faults(), kNoFault) << "only a force needs the reference";
}

TEST_F(ModeMachineTest, TheFirstJointInTroubleStaysUntilAReset) {
  activate();
  modes_.raise(EffortFinding{.faults = kNoFault, .joint = 1});
  EXPECT_EQ(modes_.fault_joint(), 0U);
  modes_.raise(EffortFinding{.faults = kFaultMotorReversed, .joint = 3});
  modes_.raise(EffortFinding{.faults = kFaultEffortMismatch, .joint = 2});
  EXPECT_EQ(modes_.fault_joint(), 3U);
  EXPECT_EQ(modes_.faults(), kFaultMotorReversed | kFaultEffortMismatch);
  tick(Request::reset);
  EXPECT_EQ(modes_.fault_joint(), 0U);
}

TEST_F(ModeMachineTest, AGuardThatIsOffRaisesNothingAndEveryTickSaysSo) {
  modes_.configure(kFaultMotorReversed);
  activate();
  modes_.raise(EffortFinding{.faults = kFaultMotorReversed, .joint = 3});
  EXPECT_EQ(modes_.mode(), Mode::active);
  EXPECT_EQ(modes_.fault_joint(), 0U);
  EXPECT_EQ(modes_.raised(), kLimitGuardsOff);
}

}  // namespace
}  // namespace tactus::firmware
