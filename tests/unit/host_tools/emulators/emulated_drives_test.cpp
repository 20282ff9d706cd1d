// The same arm on the other drives that sense where their shafts are.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/moteus_canfd/moteus_canfd.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/host_tools/emulators/emulated_arm.h"

namespace tactus::host {
namespace {

ArmDrives<drivers::MoteusCanFd> moteus_drives() {
  return {.driver =
              [](std::uint8_t i) {
                return drivers::MoteusCanFd(
                    {.servo_id = static_cast<std::uint8_t>(i + 1), .max_torque_Nm = kArmLimit_Nm});
              },
          .emulator =
              [](hal::CanBus& bus, std::uint8_t i) {
                return std::make_unique<MoteusEmulator>(
                    bus, i + 1U,
                    MoteusEmulatorConfig{.servo_id = static_cast<std::uint8_t>(i + 1)});
              },
          .network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}};
}

ArmDrives<drivers::Cia402Can> cia402_drives() {
  return {.driver =
              [](std::uint8_t i) {
                return drivers::Cia402Can({.node = static_cast<std::uint8_t>(i + 1),
                                           .leads_bus = i == 0,
                                           .counts_per_turn = 65536.0,
                                           .max_torque_Nm = kArmLimit_Nm});
              },
          .emulator =
              [](hal::CanBus& bus, std::uint8_t i) {
                return std::make_unique<Cia402Emulator>(
                    bus, i + 1U,
                    Cia402EmulatorConfig{.node = static_cast<std::uint8_t>(i + 1),
                                         .encoder = EmulatedEncoder::multi_turn,
                                         .counts_per_turn = 65536.0,
                                         .rated_torque_Nm = 0.5,
                                         .rated_torque = 500});
              }};
}

// Held still, the driver knows the joints to the drive's resolution, and the torque at the plant is
// the one commanded to its resolution: one per mille of the rated torque with CiA 402.
template <class Driver>
void expect_hold(const ArmDrives<Driver>& kind, double joint_rad, double torque_Nm) {
  EmulatedArm<Driver> device(kind);
  device.ticks(1000, [&](int) { device.hold(); });
  ASSERT_TRUE(device.are_well()) << device.board.trouble(0).what;
  device.ticks(3000, [&](int) { device.hold(); });
  ASSERT_TRUE(device.are_well()) << device.board.trouble(0).what;
  const MachineTruth truth = device.machine->truth();
  EXPECT_LT(truth.handle_v_B.norm(), 2e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(truth.joint_position[i], device.middle[i], 0.02) << i;
    EXPECT_NEAR(device.joint(i), truth.joint_position[i], joint_rad) << i;
    EXPECT_NEAR(truth.shaft_torque_Nm[i], device.commands[i].torque_Nm, torque_Nm) << i;
  }
}

TEST(EmulatedDrives, MoteusHoldsTheArmAgainstItsWeight) {
  expect_hold(moteus_drives(), 2e-5, 1e-3);
}

TEST(EmulatedDrives, Cia402HoldsTheArmAgainstItsWeight) {
  expect_hold(cia402_drives(), 2e-5, 1e-3);
}

}  // namespace
}  // namespace tactus::host
