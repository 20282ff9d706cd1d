// Every way in which the zero of an ODrive's or a VESC's position may move unseen, through a
// ComposedDevice: the joint must not be referenced afterwards until it is homed again.

#include <gtest/gtest.h>

#include <memory>
#include <string_view>

#include "drivers/odrive_can/odrive_can.h"
#include "drivers/vesc_can/vesc_can.h"
#include "hal/simulated/can_bus.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "host_tools/emulators/vesc_emulator.h"
#include "tests/unit/drivers/one_joint.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

using ODriveJoint = OneJoint<ODriveCan, host::ODriveEmulator>;
using VescJoint = OneJoint<VescCan, host::VescEmulator>;

std::unique_ptr<ODriveJoint> odrive_joint(host::ODriveFirmware firmware) {
  return std::make_unique<ODriveJoint>(
      ODriveConfig{.torque_constant_Nm_per_A = 0.055, .heartbeat_lost_s = 0.035},
      host::ODriveEmulatorConfig{.firmware = firmware, .heartbeat_ms = 10});
}

std::unique_ptr<VescJoint> vesc_joint() {
  return std::make_unique<VescJoint>(VescConfig{.torque_constant_Nm_per_A = 0.03,
                                                .max_torque_Nm = 0.3,
                                                .offers_position = true,
                                                .status_period_s = 0.001,
                                                .lost_after_s = 0.004},
                                     host::VescEmulatorConfig{.status_period_ns = 1'000'000});
}

class ODriveReference : public ::testing::TestWithParam<host::ODriveFirmware> {};

INSTANTIATE_TEST_SUITE_P(Firmware, ODriveReference,
                         ::testing::Values(host::ODriveFirmware::v0_5_2,
                                           host::ODriveFirmware::v0_5_6,
                                           host::ODriveFirmware::v0_6));

TEST_P(ODriveReference, IsGoneAfterEveryKindOfLossUntilTheJointIsHomed) {
  for (const Loss<ODriveJoint>& loss : common_losses<ODriveJoint>()) {
    SCOPED_TRACE(loss.name);
    const auto joint = odrive_joint(GetParam());
    bring_up_and_home(*joint);
    loss.happen(*joint);
    expect_only_homing_brings_it_back(*joint, loss.name);
  }
}

// An emergency stop that cuts the supply: the drive says so, dies, and boots where the arm is then.
TEST_P(ODriveReference, IsGoneAfterAnUnderVoltageAtOnceOnceItIsTold) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  if (GetParam() == host::ODriveFirmware::v0_6) {
    joint->emulator().raise(0x200);
  } else {
    joint->emulator().raise_motor_error(0x100'0000);
  }
  joint->ticks(150);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U);
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  unplug(*joint, 500);
  expect_only_homing_brings_it_back(*joint, "under-voltage");
}

TEST_P(ODriveReference, StaysThroughAFaultThatLeavesThePositionAlone) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->emulator().set_fault(EmulatorFault::erroring);
  joint->ticks(200);
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  joint->move(0.2);
  joint->emulator().set_fault(EmulatorFault::none);
  joint->ticks(100);
  joint->reset();
  EXPECT_EQ(joint->sample().status, kDeviceOk) << joint->device().trouble().trouble.what;
  EXPECT_NEAR(joint->sample().position[0], 0.5, 0.02);
}

TEST_P(ODriveReference, IsGoneWhenClosedLoopIsLeftWithoutAnError) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->emulator().drop_to_idle();
  joint->ticks(100);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U)
      << "closed loop left without an error is what a restart looks like";
}

TEST_P(ODriveReference, PowerGoesOffAfterAFaultOfTheControllerAndComesBack) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  EXPECT_EQ(joint->emulator().axis_state(), 8U);
  joint->command() = {.power_off = true};
  joint->ticks(5);
  EXPECT_EQ(joint->emulator().axis_state(), 1U);
  joint->move(0.1);
  EXPECT_EQ(joint->sample().status, kDeviceOk);
  EXPECT_NEAR(joint->sample().position[0], 0.4, 0.02);
  joint->command() = {};
  joint->ticks(2);
  EXPECT_EQ(joint->sample().status, kDeviceNotReady);
  joint->ticks(1000);
  EXPECT_EQ(joint->sample().status, kDeviceOk) << joint->device().trouble().trouble.what;
  EXPECT_EQ(joint->emulator().axis_state(), 8U);
}

TEST_P(ODriveReference, MeasuredTorqueReachesTheJoint) {
  const auto joint = odrive_joint(GetParam());
  bring_up_and_home(*joint);
  joint->command() = {.effort = {0.5}, .enable = true};
  joint->ticks(40);
  EXPECT_EQ(joint->sample().effort_known, 1U);
  EXPECT_NEAR(joint->sample().effort[0], 0.5, 1e-6);
  int measured = 0;
  for (int tick = 0; tick < 100; ++tick) {
    joint->ticks(1);
    measured += joint->sample().effort_is_new != 0 ? 1 : 0;
  }
  // It is asked every 10 ms, and firmware 0.5 for its current beside that.
  EXPECT_GE(measured, 10);
  EXPECT_LE(measured, 11);
  joint->command() = {.power_off = true};
  joint->ticks(5);
  EXPECT_EQ(joint->sample().effort_known, 0U);
}

TEST(ODriveWatchdog, DriveWhoseWatchdogIsOffIsRefusedUnlessItsOwnerAcceptsIt) {
  for (const auto firmware : {host::ODriveFirmware::v0_5_6, host::ODriveFirmware::v0_6}) {
    for (const bool accepted : {false, true}) {
      ODriveJoint joint(
          ODriveConfig{.unproven_watchdog = accepted, .heartbeat_lost_s = 0.035},
          host::ODriveEmulatorConfig{.firmware = firmware, .heartbeat_ms = 10, .watchdog_s = 0.0});
      joint.ticks(1500);
      EXPECT_EQ((joint.sample().status & kDeviceDriveFault) != 0, !accepted);
      if (!accepted) {
        EXPECT_NE(joint.device().trouble().trouble.what.find("watchdog does not stop"),
                  std::string_view::npos);
        EXPECT_EQ(joint.emulator().axis_state(), 1U);
      }
    }
  }
}

// On 0.5 every frame feeds the watchdog: beside another program's questions a dead host's torque
// would stay.
TEST(ODriveWatchdog, WatchdogThatAnotherProgramFeedsIsRefused) {
  const auto joint = odrive_joint(host::ODriveFirmware::v0_5_6);
  hal::SimulatedCanBus stranger(joint->network());
  for (int i = 0; i < 150; ++i) {
    (void)stranger.send({.id = 0x17, .remote = true});
    joint->ticks(10);
  }
  EXPECT_NE(joint->sample().status & kDeviceDriveFault, 0U);
  EXPECT_NE(joint->device().trouble().trouble.remedy.find("no other program"),
            std::string_view::npos);
}

TEST(ODriveWatchdog, SlowWatchdogIsRefusedToo) {
  ODriveJoint joint(ODriveConfig{.heartbeat_lost_s = 0.035},
                    host::ODriveEmulatorConfig{.heartbeat_ms = 10, .watchdog_s = 0.2});
  joint.ticks(1500);
  EXPECT_NE(joint.sample().status & kDeviceDriveFault, 0U);
}

TEST(VescReference, IsGoneAfterEveryKindOfLossUntilTheJointIsHomed) {
  for (const Loss<VescJoint>& loss : common_losses<VescJoint>()) {
    SCOPED_TRACE(loss.name);
    const auto joint = vesc_joint();
    bring_up_and_home(*joint);
    loss.happen(*joint);
    expect_only_homing_brings_it_back(*joint, loss.name);
  }
}

TEST(VescReference, IsGoneAfterAnUnderVoltage) {
  const auto joint = vesc_joint();
  bring_up_and_home(*joint);
  joint->emulator().set_fault_code(2);
  joint->ticks(100);
  EXPECT_NE(joint->sample().status & kDeviceReferenceLost, 0U);
  joint->emulator().set_fault_code(0);
  joint->ticks(100);
  expect_only_homing_brings_it_back(*joint, "under-voltage");
}

TEST(VescWatchdog, VescWhoseTimeoutIsAsDeliveredIsRefusedUnlessItsOwnerAcceptsIt) {
  for (const bool accepted : {false, true}) {
    VescJoint joint(
        VescConfig{.torque_constant_Nm_per_A = 0.03,
                   .max_torque_Nm = 0.3,
                   .unproven_watchdog = accepted,
                   .status_period_s = 0.001,
                   .lost_after_s = 0.004},
        host::VescEmulatorConfig{.timeout_ns = 1'000'000'000, .status_period_ns = 1'000'000});
    joint.ticks(500);
    EXPECT_EQ((joint.sample().status & kDeviceDriveFault) != 0, !accepted)
        << joint.device().trouble().trouble.what;
  }
}

}  // namespace
}  // namespace tactus::drivers
