#include "drivers/falcon_usb/falcon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/unit/drivers/falcon_usb/falcon_rig.h"

namespace tactus::drivers {
namespace {

constexpr double kHalfCount_rad = 0.5 * kFalconRadPerCount + 1e-12;

TEST(Falcon, IsNotReadyBeforeItIsStartedAndAfterItIsStopped) {
  FalconRig rig;
  rig.tick();
  EXPECT_EQ(rig.samples[0].status, kDeviceNotReady);
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  rig.driver.stop();
  rig.tick();
  EXPECT_EQ(rig.samples[0].status, kDeviceNotReady);
}

TEST(Falcon, TellsTheArmsAnglesToHalfACount) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  for (int tick = 0; tick < 500; ++tick) {
    const std::array<double, 3> angles = {0.5 + 0.3 * std::sin(0.02 * tick),
                                          0.5 - 0.4 * std::sin(0.03 * tick), 0.5};
    for (std::size_t arm = 0; arm < 3; ++arm) {
      rig.emulator.shafts()[arm].position_rad = angles[arm];
    }
    rig.driver.write(rig.commands);
    const hal::TimeNs sent_ns = rig.clock.now_ns();
    rig.clock.advance_by(FalconRig::kTick_ns);
    rig.driver.read(rig.samples, rig.clock.now_ns());
    for (std::size_t arm = 0; arm < 3; ++arm) {
      ASSERT_EQ(rig.samples[arm].status, kDeviceOk);
      ASSERT_NEAR(rig.samples[arm].position_rad, angles[arm], kHalfCount_rad);
      ASSERT_EQ(rig.samples[arm].time_ns, sent_ns);
    }
  }
}

TEST(Falcon, TellsTheSpeedOfASteadyTurn) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  for (int tick = 0; tick < 400; ++tick) {
    rig.emulator.shafts()[1].position_rad += 0.002;
    rig.tick();
  }
  EXPECT_NEAR(rig.samples[1].velocity_rad_per_s, 2.0, 0.25);  // a count a tick is 0.64 rad/s
  EXPECT_EQ(rig.samples[0].velocity_rad_per_s, 0.0);
}

TEST(Falcon, AMeasuredExchangeTakesOneAnswerATick) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  const std::uint64_t before = rig.emulator.commands();
  rig.ticks(1000);
  EXPECT_EQ(rig.emulator.commands() - before, 1000U);
  EXPECT_EQ(rig.samples[0].status, kDeviceOk);
}

TEST(Falcon, TorqueReachesTheArmWithItsSignAndScale) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  rig.commands[0] = {.torque_Nm = 0.1, .enable = true};
  rig.commands[1] = {.torque_Nm = -0.2, .enable = true};
  rig.commands[2] = {.torque_Nm = 0.3, .enable = false};
  rig.tick();
  EXPECT_NEAR(rig.emulator.shafts()[0].torque_Nm, 0.1, 1e-4);
  EXPECT_NEAR(rig.emulator.shafts()[1].torque_Nm, -0.2, 1e-4);
  EXPECT_EQ(rig.emulator.shafts()[2].torque_Nm, 0.0);
}

TEST(Falcon, TorqueIsClampedToTheDeviceAndToTheConfiguredLimit) {
  FalconRig wide({.homed = true}, {.motor_units_per_Nm = 3400.0, .torque_limit_Nm = 1000.0});
  wide.driver.start();
  ASSERT_TRUE(wide.tick_until(kDeviceOk, 50));
  wide.command(1e9);
  wide.tick();
  EXPECT_EQ(wide.emulator.motors(), (std::array<std::int16_t, 3>{-4095, -4095, -4095}));
  FalconRig narrow({.homed = true}, {.torque_limit_Nm = 0.05});
  narrow.driver.start();
  ASSERT_TRUE(narrow.tick_until(kDeviceOk, 50));
  narrow.command(-1e9);
  narrow.tick();
  EXPECT_EQ(narrow.emulator.motors(), (std::array<std::int16_t, 3>{500, 500, 500}));
}

TEST(Falcon, TorqueThatIsNoNumberIsNone) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  for (const double none :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    rig.command(none);
    rig.tick();
    EXPECT_TRUE(rig.device_feels_nothing());
  }
}

TEST(Falcon, GivesNoTorqueUntilTheGripWasPulledOutAndPushedIn) {
  FalconRig rig({.homed = false});
  rig.driver.start();
  rig.command(0.1);
  ASSERT_TRUE(rig.tick_until(kDeviceHoming, 50));
  const auto move_to = [&rig](double angle_rad) {
    for (int tick = 0; tick < 100; ++tick) {
      for (host::EmulatedShaft& shaft : rig.emulator.shafts()) {
        shaft.position_rad += 0.01 * (angle_rad > shaft.position_rad ? 1.0 : -1.0);
      }
      rig.tick();
      ASSERT_TRUE(rig.device_feels_nothing() || rig.samples[0].status == kDeviceOk);
    }
  };
  move_to(1.1);
  EXPECT_EQ(rig.samples[0].status, kDeviceHoming);
  EXPECT_EQ(rig.emulator.lights(), 8);  // red
  move_to(0.5);
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 20));
  rig.tick();
  EXPECT_NEAR(rig.samples[2].position_rad, rig.emulator.shafts()[2].position_rad, 0.011);
  EXPECT_NEAR(rig.emulator.shafts()[2].torque_Nm, 0.1, 1e-4);
  EXPECT_EQ(rig.emulator.lights(), 4);  // blue: powered
  rig.commands.fill({});
  rig.ticks(2);
  EXPECT_EQ(rig.emulator.lights(), 2);  // green
}

TEST(Falcon, UploadsItsFirmwareFirst) {
  std::vector<std::byte> image(700, std::byte{0x5A});
  image[300] = std::byte{0x01};
  FalconRig rig({.firmware_loaded = false, .image_bytes = image.size(), .homed = true},
                {.firmware = image});
  rig.driver.start();
  rig.command(0.1);
  ASSERT_TRUE(rig.tick_until(kDeviceHoming, 5000));
  EXPECT_TRUE(rig.emulator.firmware_loaded());
  EXPECT_EQ(rig.emulator.image(), image);
  EXPECT_EQ(rig.driver.bring_up().attempt(), 1U);
}

TEST(Falcon, UploadsAlsoWhereTheChipShowsALeadingZero) {
  const std::vector<std::byte> image(70, std::byte{0x22});
  FalconRig rig({.firmware_loaded = false, .image_bytes = image.size(), .leading_zero = true},
                {.firmware = image});
  rig.driver.start();
  EXPECT_TRUE(rig.tick_until(kDeviceHoming, 5000));
}

TEST(Falcon, DamagedUploadIsTriedAgain) {
  const std::vector<std::byte> image(700, std::byte{0x33});
  FalconRig rig({.firmware_loaded = false, .image_bytes = image.size()}, {.firmware = image});
  rig.driver.start();
  for (int i = 0; i < 5000 && rig.driver.bring_up().loaded_bytes() < 100; ++i) {
    rig.tick();
  }
  rig.emulator.set_fault(host::EmulatorFault::corrupted);
  for (int i = 0; i < 5000 && rig.driver.bring_up().attempt() < 2; ++i) {
    rig.tick();
  }
  rig.emulator.set_fault(host::EmulatorFault::none);
  EXPECT_TRUE(rig.tick_until(kDeviceHoming, 10'000));
  EXPECT_EQ(rig.emulator.image(), image);
}

TEST(Falcon, TakesAnswersThatComeInTwoPackets) {
  FalconRig rig({.homed = true, .split_after = 10});
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  for (int tick = 0; tick < 100; ++tick) {
    rig.tick();
    ASSERT_EQ(rig.samples[0].status, kDeviceOk);
  }
}

TEST(Falcon, TellsTheGripsButtons) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  EXPECT_EQ(rig.driver.buttons(), 0);
  rig.emulator.set_buttons(0b1010);
  rig.ticks(2);
  EXPECT_EQ(rig.driver.buttons(), kFalconButtonLeft | kFalconButtonFront);
}

TEST(Falcon, StoppingTakesTheTorqueAway) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  rig.command(0.2);
  rig.ticks(3);
  ASSERT_FALSE(rig.device_feels_nothing());
  rig.driver.stop();
  EXPECT_TRUE(rig.device_feels_nothing());
  rig.ticks(3);
  EXPECT_TRUE(rig.device_feels_nothing());
}

TEST(Falcon, ReadWaitsNoLongerThanItsDeadline) {
  FalconRig rig;
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  rig.emulator.set_fault(host::EmulatorFault::silent);
  rig.ticks(2);
  const hal::TimeNs deadline_ns = rig.clock.now_ns() + 300'000;
  rig.driver.read(rig.samples, deadline_ns);
  EXPECT_EQ(rig.clock.now_ns(), deadline_ns);
  EXPECT_NE(rig.samples[0].status & kDeviceStale, 0U);
}

}  // namespace
}  // namespace tactus::drivers
