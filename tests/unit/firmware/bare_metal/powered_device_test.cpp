#include "firmware/bare_metal/powered_device.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/firmware/bare_metal/fake_board.h"

namespace tactus::firmware {
namespace {

// A device that writes its commands down among the board's events.
struct EnabledDevice {
  static std::size_t joint_count() { return 3; }
  static void read(drivers::JointSample& sample) { sample.age_us = 17; }
  static std::uint32_t write(const drivers::JointCommand& command) {
    hal::fake_board().events += command.enable ? "enabled " : "disabled ";
    return drivers::kDeviceTooHot;
  }
  static void clear_faults() { hal::fake_board().events += "cleared "; }
};

std::string events_of(const drivers::JointCommand& command) {
  hal::power_up_fake_board();
  EnabledDevice device;
  EXPECT_EQ(PoweredDevice(device).write(command), drivers::kDeviceTooHot);
  return hal::fake_board().events;
}

TEST(PoweredDevice, GivesThePowerAfterTheDeviceHasItsCommand) {
  EXPECT_EQ(events_of({.enable = true}), "enabled on ");
}

TEST(PoweredDevice, TakesThePowerBeforeTheDeviceHasItsCommand) {
  EXPECT_EQ(events_of({.enable = false}), "off disabled ");
  EXPECT_EQ(events_of({.enable = true, .power_off = true}), "off enabled ");
}

TEST(PoweredDevice, PassesTheOtherCallsOn) {
  hal::power_up_fake_board();
  EnabledDevice device;
  PoweredDevice powered(device);
  drivers::JointSample sample;
  powered.read(sample);
  EXPECT_EQ(sample.age_us, 17U);
  EXPECT_EQ(powered.joint_count(), 3U);
  powered.clear_faults();
  EXPECT_EQ(hal::fake_board().events, "cleared ");
}

}  // namespace
}  // namespace tactus::firmware
