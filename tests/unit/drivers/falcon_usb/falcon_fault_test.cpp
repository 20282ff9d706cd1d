// Every fault of the emulator's port ends in zero torque and a latched fault that names the remedy.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/falcon_usb/falcon.h"
#include "tests/unit/drivers/falcon_usb/falcon_rig.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

// A Falcon that works, with torque on its motors.
struct WorkingFalcon : FalconRig {
  explicit WorkingFalcon(const host::FalconEmulatorConfig& device = {.homed = true})
      : FalconRig(device) {
    driver.start();
    EXPECT_TRUE(tick_until(kDeviceOk, 50));
    command(0.2);
    ticks(3);
    EXPECT_FALSE(device_feels_nothing());
  }
  // The bits that stay until faults are cleared.
  std::uint32_t latched() const {
    return samples[0].status & (kDeviceLost | kDeviceEncoderFault | kDeviceDriveFault);
  }
};

TEST(FalconFault, SilentDeviceIsLostWithinFiveTicksAndGetsZero) {
  WorkingFalcon rig;
  rig.emulator.set_fault(EmulatorFault::silent);
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.device_feels_nothing());
  EXPECT_EQ(rig.driver.trouble(0).what, "the Falcon does not answer");
  rig.emulator.set_fault(EmulatorFault::none);
  rig.ticks(100);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.device_feels_nothing());
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceOk, 50));
  EXPECT_FALSE(rig.driver.trouble(0));
}

TEST(FalconFault, DelayedDeviceIsLostToo) {
  WorkingFalcon rig;
  rig.emulator.set_fault(EmulatorFault::delayed);
  rig.ticks(6);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_TRUE(rig.device_feels_nothing());
}

TEST(FalconFault, OneLateAnswerIsStaleAndNoMore) {
  WorkingFalcon rig;
  rig.emulator.set_fault(EmulatorFault::delayed);
  rig.tick();
  rig.emulator.set_fault(EmulatorFault::none);
  bool stale = false;
  for (int i = 0; i < 20; ++i) {
    rig.tick();
    stale = stale || rig.samples[0].status == kDeviceStale;
  }
  EXPECT_TRUE(stale);
}

TEST(FalconFault, CorruptedPacketsNeverMakeAJumpAndEndInAFault) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    FalconRig rig({.homed = true}, {}, seed);
    rig.driver.start();
    ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
    rig.command(0.1);
    rig.emulator.set_fault(EmulatorFault::corrupted);
    for (int i = 0; i < 500; ++i) {
      rig.tick();
      if (rig.samples[0].status == kDeviceOk) {
        for (const AxisSample& sample : rig.samples) {
          ASSERT_NEAR(sample.position_rad, 0.5, 0.3);
        }
      }
    }
    EXPECT_EQ(rig.samples[0].status & kDeviceEncoderFault, kDeviceEncoderFault);
    EXPECT_FALSE(rig.driver.trouble(0).remedy.empty());
    EXPECT_TRUE(rig.device_feels_nothing());
  }
}

TEST(FalconFault, LostReferenceIsAFaultThatAsksForHoming) {
  WorkingFalcon rig;
  rig.emulator.set_fault(EmulatorFault::erroring);
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceEncoderFault);
  EXPECT_TRUE(rig.device_feels_nothing());
  EXPECT_EQ(rig.driver.trouble(2).what, "the Falcon lost its reference");
  EXPECT_NE(rig.driver.trouble(2).remedy.find("pull the grip out"), std::string_view::npos);
  rig.emulator.set_fault(EmulatorFault::none);
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceHoming | kDeviceReferenceLost, 50));
}

TEST(FalconFault, UnpluggedDeviceIsLostFromTheFirstFailureOn) {
  WorkingFalcon rig;
  rig.peer.unplug();
  rig.tick();
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_EQ(rig.driver.trouble(0).what, "a USB transfer to the Falcon failed");
  EXPECT_EQ(rig.driver.motors(), (std::array<std::int16_t, 3>{}));
  rig.ticks(10);
  EXPECT_EQ(rig.driver.trouble(0).what, "the Falcon is unplugged");
  EXPECT_NE(rig.driver.trouble(0).remedy.find("plug in"), std::string_view::npos);
  rig.driver.clear_faults();
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceLost);
}

TEST(FalconFault, DeviceThatCameBackIsOpenedWhenFaultsAreCleared) {
  WorkingFalcon rig;
  rig.peer.unplug();
  rig.ticks(10);
  rig.peer.plug_in();
  rig.ticks(10);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  rig.driver.clear_faults();
  ASSERT_TRUE(rig.tick_until(kDeviceDriveFault | kDeviceNotReady | kDeviceReferenceLost,
                             5000));  // its firmware is gone
  EXPECT_EQ(rig.driver.trouble(0).what, "the Falcon has no firmware");
  EXPECT_NE(rig.driver.trouble(0).remedy.find("firmware file"), std::string_view::npos);
}

TEST(FalconFault, DeviceThatCameBackIsLoadedAndHomedAnew) {
  const std::vector<std::byte> image(200, std::byte{7});
  FalconRig rig({.image_bytes = image.size(), .homed = true}, {.firmware = image});
  rig.driver.start();
  ASSERT_TRUE(rig.tick_until(kDeviceOk, 50));
  rig.command(0.1);
  rig.ticks(5);
  rig.peer.unplug();
  rig.ticks(10);
  rig.peer.plug_in();
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceHoming | kDeviceReferenceLost, 5000));
  rig.ticks(100);
  EXPECT_EQ(rig.samples[0].status, kDeviceHoming | kDeviceReferenceLost);
}

TEST(FalconFault, StoppedDeviceIsLost) {
  WorkingFalcon rig;
  rig.peer.endpoint().set_stopped(true);
  rig.ticks(5);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_FALSE(rig.driver.trouble(0).remedy.empty());
  rig.peer.endpoint().set_stopped(false);
  rig.ticks(5);
  EXPECT_TRUE(rig.device_feels_nothing());
}

TEST(FalconFault, DeviceThatTakesNothingIsLost) {
  WorkingFalcon rig;
  rig.peer.endpoint().take_only(0);
  rig.ticks(6);
  EXPECT_EQ(rig.latched(), kDeviceLost);
}

TEST(FalconFault, FailedTransferIsNotTriedAgain) {
  WorkingFalcon rig;
  rig.peer.endpoint().fail_next(1, hal::ErrorCode::io);
  rig.ticks(5);  // the reads before it in flight are well
  EXPECT_EQ(rig.latched(), kDeviceLost);
  rig.ticks(2);
  EXPECT_TRUE(rig.device_feels_nothing());
  rig.driver.clear_faults();
  EXPECT_TRUE(rig.tick_until(kDeviceOk, 50));
}

TEST(FalconFault, HaltedEndpointIsATransferFault) {
  WorkingFalcon rig;
  rig.peer.endpoint().set_halted(true);
  rig.ticks(2);
  EXPECT_EQ(rig.latched(), kDeviceLost);
  EXPECT_EQ(rig.driver.trouble(0).what, "a USB transfer to the Falcon failed");
}

TEST(FalconFault, ArmThatLeapsIsAnEncoderFaultAndNoPosition) {
  WorkingFalcon rig;
  rig.emulator.shafts()[1].position_rad += 0.4;
  for (int i = 0; i < 4; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.samples[1].position_rad, 0.5, 0.001);
  }
  EXPECT_EQ(rig.latched(), kDeviceEncoderFault);
  EXPECT_EQ(rig.driver.trouble(1).what, "the Falcon's arms seem to jump");
  EXPECT_TRUE(rig.device_feels_nothing());
}

TEST(FalconFault, FastestHandIsNoJump) {
  WorkingFalcon rig;
  for (int i = 0; i < 20; ++i) {
    rig.emulator.shafts()[0].position_rad += 0.05;  // 50 rad/s
    rig.tick();
    ASSERT_EQ(rig.samples[0].status, kDeviceOk);
  }
}

TEST(FalconFault, ClearingNothingLeavesAWellDeviceAlone) {
  WorkingFalcon rig;
  rig.driver.clear_faults();
  rig.tick();
  EXPECT_EQ(rig.samples[0].status, kDeviceOk);
}

TEST(FalconFault, EveryLossOfAHomedDeviceIsALostReference) {
  for (const EmulatorFault fault :
       {EmulatorFault::silent, EmulatorFault::erroring, EmulatorFault::power_cycled}) {
    SCOPED_TRACE(static_cast<int>(fault));
    WorkingFalcon rig;
    rig.emulator.set_fault(fault);
    rig.ticks(20);
    EXPECT_NE(rig.samples[0].status & kDeviceReferenceLost, 0U);
    rig.driver.clear_faults();
    rig.tick();
    EXPECT_NE(rig.samples[0].status & kDeviceReferenceLost, 0U);
    rig.ticks(500);
    EXPECT_NE(rig.samples[0].status & kDeviceReferenceLost, 0U);
  }
}

TEST(FalconFault, WithoutTheOverrideTheDeviceIsRefused) {
  hal::SimulatedClock clock;
  host::FalconEmulator emulator({.homed = true}, 1);
  host::FalconUsbPeer peer(emulator, clock);
  Falcon driver(peer.endpoint(), clock, {});
  driver.start();
  std::array<AxisSample, kFalconArms> samples{};
  for (int i = 0; i < 100; ++i) {
    driver.read(samples, clock.now_ns() + 500'000);
    driver.write(std::array<AxisCommand, kFalconArms>{});
    clock.advance_by(1'000'000);
  }
  EXPECT_EQ(samples[0].status, kDeviceDriveFault | kDeviceNotReady);
  EXPECT_NE(driver.trouble(0).remedy.find("unproven_watchdog = true"), std::string_view::npos);
  EXPECT_EQ(emulator.commands(), 0U);
}

}  // namespace
}  // namespace tactus::drivers
