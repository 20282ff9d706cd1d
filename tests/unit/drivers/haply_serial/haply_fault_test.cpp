// Every fault of the emulator's port ends in zero torque and a latched fault that names the remedy.
#include <gtest/gtest.h>

#include "drivers/haply_serial/haply.h"
#include "tests/unit/drivers/haply_serial/haply_rig.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

// A board that works, with torque on its motors.
struct WorkingHaply : HaplyRig {
  explicit WorkingHaply(std::uint32_t seed = 1) : HaplyRig(pantograph_config(), seed) {
    driver.start();
    EXPECT_TRUE(tick_until(kDeviceOk, 100));
    command(0.1);
    ticks(3);
    EXPECT_FALSE(arms_feel_nothing());
  }
  // The bits that stay until faults are cleared.
  std::uint32_t latched() const {
    return samples[0].status & (kDeviceLost | kDeviceEncoderFault | kDeviceDriveFault);
  }
};

TEST(HaplyFault, SilentBoardIsLostAndGetsZero) {
  WorkingHaply rig;
  rig.board().set_fault(EmulatorFault::silent);
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.arms_feel_nothing());
  EXPECT_EQ(rig.driver.trouble(0).what, "the Haply board does not answer");
  EXPECT_NE(rig.driver.trouble(0).remedy.find("home pose"), std::string_view::npos);
  rig.board().set_fault(EmulatorFault::none);
  rig.ticks(100);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.arms_feel_nothing());
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceOk, 100));
}

TEST(HaplyFault, DelayedBoardIsLostToo) {
  WorkingHaply rig;
  rig.board().set_fault(EmulatorFault::delayed);
  rig.ticks(6);
  EXPECT_NE(rig.latched(), kDeviceOk);
  EXPECT_TRUE(rig.arms_feel_nothing());
}

TEST(HaplyFault, CorruptedAnswersNeverMakeAJumpAndEndInAFault) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    WorkingHaply rig(seed);
    rig.board().set_fault(EmulatorFault::corrupted);
    for (int i = 0; i < 2000 && rig.latched() == kDeviceOk; ++i) {
      rig.tick();
      if (rig.samples[0].status == kDeviceOk) {
        ASSERT_NEAR(rig.samples[0].position_rad, std::numbers::pi, 0.3);
        ASSERT_NEAR(rig.samples[1].position_rad, 0.0, 0.3);
      }
    }
    rig.ticks(1);
    EXPECT_NE(rig.latched(), kDeviceOk);
    EXPECT_TRUE(rig.arms_feel_nothing());
    EXPECT_FALSE(rig.driver.trouble(1).remedy.empty());
  }
}

TEST(HaplyFault, BoardThatForgotItsSetupIsNotBelieved) {
  WorkingHaply rig;
  rig.board().set_fault(EmulatorFault::erroring);
  rig.ticks(6);
  EXPECT_NE(rig.latched(), kDeviceOk);
  EXPECT_TRUE(rig.arms_feel_nothing());
  EXPECT_FALSE(rig.driver.trouble(0).remedy.empty());
  rig.board().set_fault(EmulatorFault::none);
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceOk, 100));
}

TEST(HaplyFault, UnpluggedBoardIsLostAndOpenedAgainWhenItIsBack) {
  WorkingHaply rig;
  rig.peer.unplug();
  rig.tick();
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_EQ(rig.driver.trouble(0).what, "the Haply board is unplugged");
  rig.driver.clear_faults();
  rig.ticks(50);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  rig.peer.plug_in();
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceOk, 100));
}

TEST(HaplyFault, CommandTakenInPartIsALostBoard) {
  WorkingHaply rig;
  rig.peer.host().take_only(5);
  rig.tick();
  rig.tick();
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_EQ(rig.driver.trouble(0).what, "the Haply board takes no more commands");
}

TEST(HaplyFault, FailedTransferIsALostBoard) {
  WorkingHaply rig;
  rig.peer.host().fail_next(1, hal::ErrorCode::io);
  rig.ticks(2);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.arms_feel_nothing());
}

TEST(HaplyFault, ArmThatLeapsIsAnEncoderFaultAndNoPosition) {
  WorkingHaply rig;
  rig.board().shafts()[1].position_rad += 0.5;
  for (int i = 0; i < 4; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.samples[1].position_rad, 0.0, 0.001);
  }
  EXPECT_EQ(rig.latched(), kDeviceEncoderFault);
  EXPECT_EQ(rig.driver.trouble(1).what, "the Haply's arms seem to jump");
  EXPECT_TRUE(rig.arms_feel_nothing());
}

TEST(HaplyFault, SetupThatWasNotTakenIsNoticed) {
  HaplyRig rig;
  rig.driver.start();
  rig.clock.advance_by(5'000'000);
  // The arms move between the setup and the first answer: what is home is not known any more.
  rig.board().shafts()[0].position_rad -= 0.3;
  rig.ticks(40);
  EXPECT_EQ(rig.samples[0].status & kDeviceEncoderFault, kDeviceEncoderFault);
  EXPECT_NE(rig.samples[0].status & kDeviceNotReady, 0U);
  EXPECT_EQ(rig.driver.trouble(0).what, "the Haply board did not take its setup");
}

}  // namespace
}  // namespace tactus::drivers
