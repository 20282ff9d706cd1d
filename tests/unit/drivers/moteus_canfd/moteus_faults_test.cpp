#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "drivers/moteus_canfd/moteus_canfd.h"
#include "drivers/moteus_canfd/moteus_protocol.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/drivers/can_rig.h"
#include "tests/unit/drivers/drive_faults.h"

namespace tactus::drivers {
namespace {

// Set up as README.md asks: free when it times out.
class MoteusFaults : public DriveFaults<MoteusCanFd, host::MoteusEmulator>,
                     public ::testing::WithParamInterface<MoteusQuery> {
 protected:
  MoteusFaults()
      : DriveFaults({.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}},
                    MoteusConfig{.query = GetParam()},
                    host::MoteusEmulatorConfig{.timeout_mode = 0}) {}
};

INSTANTIATE_TEST_SUITE_P(Query, MoteusFaults,
                         ::testing::Values(MoteusQuery::with_command, MoteusQuery::before_command));

TEST_P(MoteusFaults, SilentServoIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(host::EmulatorFault::silent);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 5 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(MoteusFaults, DelayedServoIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(host::EmulatorFault::delayed);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 5 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(MoteusFaults, CorruptedServoIsStoppedOnceItShows) {
  rig_.emulator(0).set_fault(host::EmulatorFault::corrupted);
  const Reaction reaction = react(100 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_GT(reaction.torque_gone_ns, 0);
  EXPECT_LE(reaction.torque_gone_ns, reaction.latched_ns + 2 * kMs);
  expect_latched(kDeviceEncoderFault | kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

TEST_P(MoteusFaults, ErringServoIsLatchedInTwoTicksWithItsWords) {
  rig_.emulator(0).set_fault(host::EmulatorFault::erroring);
  const Reaction reaction = react(20 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 3 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 2 * kMs);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(trouble().what, "the servo's motor driver reports a fault");
  EXPECT_EQ(trouble().code, 33U);
  EXPECT_EQ(rig_.emulator(0).mode(), 0) << "not stopped";
  expect_recovery();
}

TEST_P(MoteusFaults, HeatIsToldApart) {
  rig_.emulator(0).raise_fault(38);
  react(20 * kMs);
  EXPECT_EQ(status(), kDeviceDriveFault | kDeviceTooHot);
  EXPECT_EQ(torque_Nm(), 0.0);
  EXPECT_EQ(trouble().what, "the servo is too hot");
  expect_recovery();
}

TEST_P(MoteusFaults, UnpluggedServoIsLostInFiveMilliseconds) {
  rig_.emulator(0).set_fault(host::EmulatorFault::unplugged);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 2 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(MoteusFaults, HostThatFallsSilentLeavesNoTorque) {
  rig_.idle(25 * kMs);  // beyond the watchdog of 20 ms
  EXPECT_EQ(rig_.emulator(0).mode(), 11);
  EXPECT_EQ(torque_Nm(), 0.0);
  rig_.run(10 * kMs);
  expect_latched(kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

TEST_P(MoteusFaults, LimitIsNoFault) {
  rig_.emulator(0).limit(101);
  rig_.run(10 * kMs);
  EXPECT_EQ(status(), kDeviceOk);
  EXPECT_EQ(rig_.driver(0).readings().limit, 101U);
  rig_.emulator(0).limit(0);
  rig_.run(3 * kMs);
  EXPECT_EQ(rig_.driver(0).readings().limit, 0U);
}

TEST_P(MoteusFaults, ServoThatAnotherHostStopsIsLatched) {
  hal::SimulatedCanBus stranger(rig_.network());
  ASSERT_TRUE(stranger.send(moteus::stop({.servo = 1, .host = 5}, false)));
  react(20 * kMs);
  expect_latched(kDeviceDriveFault);
  expect_recovery();
}

TEST_P(MoteusFaults, PositionThatIsNoNumberIsNeverReported) {
  const double before_rad = rig_.sample(0).position_rad;
  rig_.emulator(0).lose_position(true);
  rig_.run(3 * kMs);
  expect_latched(kDeviceEncoderFault);
  EXPECT_NEAR(rig_.sample(0).position_rad, before_rad, 0.01);
  rig_.emulator(0).lose_position(false);
  expect_recovery();
}

TEST_P(MoteusFaults, PositionThatJumpsIsNeverReported) {
  const double before_rad = rig_.sample(0).position_rad;
  rig_.emulator(0).shaft().position_rad += 1.0;
  rig_.run(3 * kMs);
  expect_latched(kDeviceEncoderFault);
  EXPECT_NEAR(rig_.sample(0).position_rad, before_rad, 0.05);
}

TEST_P(MoteusFaults, TwoLostRepliesAreNoFault) {
  rig_.network().lose_next(GetParam() == MoteusQuery::with_command ? 2 : 4);
  rig_.run(10 * kMs);
  EXPECT_EQ(status(), kDeviceOk) << trouble().what;
}

TEST(MoteusDeadlines, LateReplyIsStaleUntilItComes) {
  for (const MoteusQuery query : {MoteusQuery::with_command, MoteusQuery::before_command}) {
    CanRig<MoteusCanFd, host::MoteusEmulator> rig(
        {.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}},
        std::vector<MoteusConfig>{{.query = query, .reply_lost_s = 0.006}},
        std::vector<host::MoteusEmulatorConfig>{{}});
    rig.start();
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    rig.network().lose_next(query == MoteusQuery::with_command ? 3 : 6);
    bool was_stale = false;
    rig.run(20 * kMs,
            [&](auto& samples, auto&) { was_stale |= samples[0].status == kDeviceStale; });
    EXPECT_TRUE(was_stale);
    EXPECT_EQ(rig.sample(0).status, kDeviceOk) << rig.board().trouble(0).what;
  }
}

TEST(MoteusRefusals, SilenceFromTheStartIsLostWithWhatToCheck) {
  CanRig<MoteusCanFd, host::MoteusEmulator> rig({.network = {.fd = true}},
                                                std::vector<MoteusConfig>{{.servo_id = 4}},
                                                std::vector<host::MoteusEmulatorConfig>{{}});
  rig.start();
  rig.run(1100 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceLost, 0U);
  EXPECT_NE(rig.board().trouble(0).remedy.find("servo id"), std::string_view::npos);
}

TEST(MoteusRefusals, FirmwareWithoutARegisterIsTold) {
  MoteusCanFd drive({});
  drive.start(kMs);
  drive.take({.time_ns = 2 * kMs, .frame = frame_of("100##1 30 2b 01 21 00 0a 50 50")});
  EXPECT_NE(drive.sample().status & kDeviceDriveFault, 0U);
  EXPECT_EQ(drive.trouble().code, 0x2BU);
}

TEST(MoteusRefusals, LostPositionWhileStartingIsAnEncoderFault) {
  CanRig<MoteusCanFd, host::MoteusEmulator> rig({.network = {.fd = true}},
                                                std::vector<MoteusConfig>{{}},
                                                std::vector<host::MoteusEmulatorConfig>{{}});
  rig.emulator(0).lose_position(true);
  rig.start();
  rig.run(1200 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceEncoderFault, 0U) << rig.board().trouble(0).what;
}

// A servo in its factory settings brakes after the time-out. That is a torque, but never one that
// drives.
TEST(MoteusTimeout, ServoThatWasNotSetUpBrakesInsteadOfLettingGo) {
  CanRig<MoteusCanFd, host::MoteusEmulator> rig({.network = {.fd = true}},
                                                std::vector<MoteusConfig>{{}},
                                                std::vector<host::MoteusEmulatorConfig>{{}});
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(50 * kMs);
  rig.idle(25 * kMs);
  const host::EmulatedShaft& shaft = rig.emulator(0).shaft();
  EXPECT_NE(shaft.torque_Nm, 0.0);
  EXPECT_LE(shaft.torque_Nm * shaft.velocity_rad_per_s, 0.0);
}

}  // namespace
}  // namespace tactus::drivers
