// Every fault of the emulator's port ends in zero torque and a latched fault that names the remedy.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

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

TEST(HaplyFault, ClearingNothingSendsNothingAndMovesNoZero) {
  WorkingHaply rig;
  for (int i = 0; i < 100; ++i) {
    rig.board().shafts()[0].position_rad -= 0.003;
    rig.tick();
  }
  const auto setups = rig.board().setups();
  rig.driver.clear_faults();
  rig.ticks(200);
  EXPECT_EQ(rig.samples[0].status, kDeviceOk);
  EXPECT_EQ(rig.board().setups(), setups);
  EXPECT_NEAR(rig.samples[0].position_rad, rig.board().shafts()[0].position_rad, 0.001);
}

TEST(HaplyFault, BoardThatIsSetUpAgainHasLostItsReference) {
  for (const EmulatorFault fault :
       {EmulatorFault::silent, EmulatorFault::erroring, EmulatorFault::power_cycled}) {
    SCOPED_TRACE(static_cast<int>(fault));
    WorkingHaply rig;
    rig.board().set_fault(fault);
    rig.ticks(20);
    EXPECT_NE(rig.samples[0].status & kDeviceReferenceLost, 0U);
    rig.ticks(400);
    rig.board().set_fault(EmulatorFault::none);
    rig.driver.clear_faults();
    rig.tick();
    EXPECT_NE(rig.samples[0].status & kDeviceReferenceLost, 0U);
    EXPECT_TRUE(rig.tick_until(kDeviceOk, 200));
  }
}

TEST(HaplyFault, WithoutTheOverrideTheBoardIsRefusedAndGetsNothing) {
  HaplyConfig config = pantograph_config();
  config.unproven_watchdog = false;
  HaplyRig rig(config);
  rig.driver.start();
  rig.command(0.1);
  rig.ticks(100);
  rig.driver.clear_faults();
  rig.ticks(100);
  EXPECT_EQ(rig.samples[0].status, kDeviceDriveFault | kDeviceNotReady);
  EXPECT_NE(rig.driver.trouble(0).remedy.find("unproven_watchdog = true"), std::string_view::npos);
  EXPECT_EQ(rig.board().setups() + rig.board().commands(), 0U);
}

// A line with no Haply board at its end; arms at home would be at 0 and 0.
struct StrangeLine {
  StrangeLine() {
    host.connect(other);
    HaplyConfig config;
    config.unproven_watchdog = true;
    driver.emplace(host, clock, config);
    driver->start();
  }
  // True if the driver ever says that all is well.
  template <class Answer>
  bool is_taken_for_a_board(const Answer& answer) {
    bool taken = false;
    commands.fill({.torque_Nm = 0.1, .enable = true});
    for (int i = 0; i < 1000; ++i) {
      driver->read(samples, clock.now_ns() + 500'000);
      taken = taken || samples[0].status == kDeviceOk;
      driver->write(commands);
      answer();
      clock.advance_by(1'000'000);
      if (i % 100 == 99) {
        driver->clear_faults();
      }
    }
    return taken;
  }

  hal::SimulatedClock clock;
  hal::SimulatedSerialPort host{clock};
  hal::SimulatedSerialPort other{clock};
  std::optional<Haply> driver;
  std::array<AxisSample, kHaplyMaxAxes> samples{};
  std::array<AxisCommand, kHaplyMaxAxes> commands{};
};

TEST(HaplyFault, LineThatFloodsOneByteIsNoBoard) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{9}, std::size_t{64}}) {
    for (const std::byte byte : {std::byte{5}, std::byte{0}}) {
      SCOPED_TRACE(size);
      StrangeLine line;
      const std::vector<std::byte> flood(size, byte);
      EXPECT_FALSE(line.is_taken_for_a_board([&] { (void)line.other.write(flood, hal::kNoWait); }));
    }
  }
}

TEST(HaplyFault, LineThatAlwaysSaysHomeIsNoBoard) {
  StrangeLine line;
  const std::array<std::byte, 9> home = {std::byte{5}};
  EXPECT_FALSE(line.is_taken_for_a_board([&] { (void)line.other.write(home, hal::kNoWait); }));
}

TEST(HaplyFault, LineThatSendsBackWhatItHearsIsNoBoard) {
  StrangeLine line;
  EXPECT_FALSE(line.is_taken_for_a_board([&] {
    std::array<std::byte, 256> heard{};
    if (const auto got = line.other.read(heard, hal::kNoWait)) {
      (void)line.other.write(std::span(heard).first(*got), hal::kNoWait);
    }
  }));
}

TEST(HaplyFault, AnswersThatNobodyAskedForAreAFault) {
  StrangeLine line;
  std::array<std::byte, 9> answer = {std::byte{5}};
  int asked = 0;
  int well = 0;
  EXPECT_TRUE(line.is_taken_for_a_board([&] {
    std::array<std::byte, 256> heard{};
    const std::size_t got = line.other.read(heard, hal::kNoWait).value_or(0);
    if (got >= 26) {  // ends in the setup: counts from these angles
      std::copy_n(heard.data() + got - 16, 4, answer.data() + 1);
      std::copy_n(heard.data() + got - 8, 4, answer.data() + 5);
    } else if (got == 10) {
      (void)line.other.write(answer, hal::kNoWait);
      asked += line.samples[0].status == kDeviceOk ? 1 : 0;
      if (asked > 5) {
        (void)line.other.write(answer, hal::kNoWait);  // one more than was asked for
        well += line.samples[0].status == kDeviceOk ? 1 : 0;
      }
    }
  }));
  EXPECT_LT(well, 10 * 5);  // of the ten times that it was reset
}

}  // namespace
}  // namespace tactus::drivers
