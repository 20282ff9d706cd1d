#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>

#include "drivers/odrive_can/odrive_can.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "tests/unit/drivers/can_rig.h"
#include "tests/unit/drivers/drive_faults.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

// Heartbeats every 10 ms as README.md asks for.
class ODriveFaults : public DriveFaults<ODriveCan, host::ODriveEmulator> {
 protected:
  explicit ODriveFaults(host::ODriveFirmware firmware = host::ODriveFirmware::v0_6)
      : DriveFaults(
            {}, ODriveConfig{.node_id = 1, .heartbeat_lost_s = 0.035},
            host::ODriveEmulatorConfig{.node_id = 1, .firmware = firmware, .heartbeat_ms = 10}) {}
};

class OldODriveFaults : public ODriveFaults {
 protected:
  OldODriveFaults() : ODriveFaults(host::ODriveFirmware::v0_5_6) {}
};

class ODriveFaultsByFirmware : public ODriveFaults,
                               public ::testing::WithParamInterface<host::ODriveFirmware> {
 protected:
  ODriveFaultsByFirmware() : ODriveFaults(GetParam()) {}
};

INSTANTIATE_TEST_SUITE_P(Firmware, ODriveFaultsByFirmware,
                         ::testing::Values(host::ODriveFirmware::v0_5_2,
                                           host::ODriveFirmware::v0_5_4,
                                           host::ODriveFirmware::v0_5_6,
                                           host::ODriveFirmware::v0_6));

TEST_P(ODriveFaultsByFirmware, SilentDriveIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::silent);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 5 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, DelayedDriveIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::delayed);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 5 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, CorruptedDriveIsStoppedOnceItShows) {
  rig_.emulator(0).set_fault(EmulatorFault::corrupted);
  const Reaction reaction = react(100 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_GT(reaction.torque_gone_ns, 0);
  EXPECT_LE(reaction.torque_gone_ns, reaction.latched_ns + 2 * kMs);
  expect_latched(kDeviceEncoderFault | kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, ErringDriveLosesItsTorqueAtOnceAndIsToldByTheNextHeartbeat) {
  rig_.emulator(0).set_fault(EmulatorFault::erroring);
  const Reaction reaction = react(100 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 2 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 13 * kMs);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(trouble().what, "the drive's gate driver reports a fault");
  EXPECT_EQ(trouble().code, GetParam() == host::ODriveFirmware::v0_6 ? 0x20U : 0x8U);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, UnpluggedDriveIsLostInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::unplugged);
  const Reaction reaction = react(50 * kMs);
  EXPECT_GT(reaction.latched_ns, 0);
  EXPECT_LE(reaction.latched_ns, 5 * kMs);
  EXPECT_LE(reaction.torque_gone_ns, 2 * kMs);
  expect_latched(kDeviceLost);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, HostThatFallsSilentLeavesNoTorque) {
  rig_.idle(25 * kMs);  // beyond the drive's watchdog of 20 ms
  EXPECT_EQ(torque_Nm(), 0.0);
  rig_.run(20 * kMs);
  expect_latched(kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, DriveThatGoesIdleByItselfIsLatched) {
  rig_.emulator(0).drop_to_idle();
  react(20 * kMs);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(trouble().what, "the drive left closed loop by itself");
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, EmergencyStopIsToldApart) {
  rig_.emulator(0).raise(GetParam() == host::ODriveFirmware::v0_6 ? 0x0200'0000 : 0x4000);
  react(20 * kMs);
  expect_latched(kDeviceEmergencyStop);
  expect_latched(kDeviceDriveFault);
  expect_recovery();
}

TEST_P(ODriveFaultsByFirmware, HeatIsToldApart) {
  rig_.emulator(0).raise(GetParam() == host::ODriveFirmware::v0_6 ? 0x4000 : 0x40000);
  react(20 * kMs);
  EXPECT_EQ(status(), kDeviceDriveFault | kDeviceTooHot);
  EXPECT_EQ(torque_Nm(), 0.0);
  expect_recovery();
}

// Its axis says no more than that the motor has an error, which is then asked for.
TEST_F(OldODriveFaults, HeatOfTheMotorIsToldApart) {
  rig_.emulator(0).raise_motor_error(0x20000);
  rig_.run(400 * kMs);
  EXPECT_EQ(status(), kDeviceDriveFault | kDeviceTooHot);
  EXPECT_EQ(trouble().what, "the motor is too hot");
  expect_recovery();
}

TEST_F(ODriveFaults, PositionThatIsNoNumberIsNeverReported) {
  const double before_rad = rig_.sample(0).position_rad;
  rig_.emulator(0).send_not_a_number(rig_.clock().now_ns());
  rig_.run(2 * kMs);
  expect_latched(kDeviceEncoderFault);
  EXPECT_NEAR(rig_.sample(0).position_rad, before_rad, 0.01);
}

TEST_F(ODriveFaults, PositionThatJumpsIsNeverReported) {
  const double before_rad = rig_.sample(0).position_rad;
  rig_.emulator(0).shaft().position_rad += 1.0;
  rig_.run(3 * kMs);
  expect_latched(kDeviceEncoderFault);
  EXPECT_NEAR(rig_.sample(0).position_rad, before_rad, 0.05);
}

TEST_F(ODriveFaults, FrameOfAWrongLengthIsCountedAndDoesNoHarm) {
  rig_.emulator(0).send_wrong_length(rig_.clock().now_ns());
  rig_.run(5 * kMs);
  EXPECT_EQ(status(), kDeviceOk);
  EXPECT_EQ(rig_.driver(0).readings().malformed, 1U);
}

TEST_F(ODriveFaults, TwoLostEstimatesAreNoFault) {
  rig_.network().lose_next(3);  // with the torque between them
  rig_.run(10 * kMs);
  EXPECT_EQ(status(), kDeviceOk) << trouble().what;
}

TEST_F(ODriveFaults, LinkThatGoesDownIsLostAtOnce) {
  rig_.host().set_link_up(false);
  rig_.run(2 * kMs);
  EXPECT_NE(status() & kDeviceLost, 0U);
  EXPECT_NE(trouble().remedy.find("ip link"), std::string_view::npos);
  rig_.run(30 * kMs);
  EXPECT_EQ(torque_Nm(), 0.0);  // the drive's watchdog
  rig_.host().set_link_up(true);
  rig_.board().clear_faults();
  EXPECT_GT(rig_.run_until_well(1500 * kMs), 0) << trouble().what;
}

// The restart is so soon that neither a heartbeat nor an estimate is missing.
TEST_F(ODriveFaults, ErrorThatIsGoneByItselfIsARestart) {
  rig_.emulator(0).raise(0x20);
  react(20 * kMs);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(status() & kDeviceReferenceLost, 0U);
  hal::SimulatedCanBus restarted(rig_.network());
  ASSERT_TRUE(restarted.send(frame_of("021#0000000001000000")));
  rig_.run(2 * kMs);
  EXPECT_NE(status() & kDeviceReferenceLost, 0U);
}

TEST_F(ODriveFaults, ForeignTrafficAndAFloodedBusDoNoHarm) {
  hal::SimulatedCanBus stranger(rig_.network());
  rig_.run(300 * kMs, [&](auto&, auto&) {
    ASSERT_TRUE(stranger.send({.id = 0x029 + 0x20, .length = 8}));  // another node's estimates
    ASSERT_TRUE(stranger.send({.id = 0x7F0, .length = 8}));
  });
  EXPECT_EQ(status(), kDeviceOk) << trouble().what;
}

// The drive alone would not obey them either: two things keep the torque away.
TEST(ODriveFrames, CarryNoTorqueBeforeTheDriveIsUpNorAfterAFault) {
  CanRig<ODriveCan, host::ODriveEmulator> rig(
      {.record = true}, std::vector<ODriveConfig>{{.node_id = 1}},
      std::vector<host::ODriveEmulatorConfig>{{.node_id = 1}});
  std::size_t seen = 0;
  const auto torques = [&rig, &seen] {
    std::pair<int, int> none_and_some;
    for (; seen < rig.log().size(); ++seen) {
      const std::string& line = rig.log()[seen];
      if (line.find(" 02E#") != std::string::npos) {
        ++(line.ends_with("#00000000") ? none_and_some.first : none_and_some.second);
      }
    }
    return none_and_some;
  };
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until(1500 * kMs, [&rig] { return rig.emulator(0).axis_state() == 8; }), 0);
  const auto [none_before, some_before] = torques();
  EXPECT_GT(none_before, 10);
  EXPECT_EQ(some_before, 0);
  ASSERT_GT(rig.run_until_well(1500 * kMs), 0) << rig.board().trouble(0).what;
  rig.run(20 * kMs);
  EXPECT_GE(torques().second, 20);
  rig.emulator(0).set_fault(EmulatorFault::silent);
  rig.run(10 * kMs);
  ASSERT_NE(rig.sample(0).status & kDeviceLost, 0U);
  torques();
  rig.run(50 * kMs);
  EXPECT_EQ(torques(), std::pair(50, 0));
}

TEST(ODriveDeadlines, LateEstimateIsStaleUntilItComes) {
  CanRig<ODriveCan, host::ODriveEmulator> rig({},
                                              std::vector<ODriveConfig>{{.estimate_lost_s = 0.006}},
                                              std::vector<host::ODriveEmulatorConfig>{{}});
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.network().lose_next(7);
  bool was_stale = false;
  rig.run(20 * kMs, [&](auto& samples, auto&) { was_stale |= samples[0].status == kDeviceStale; });
  EXPECT_TRUE(was_stale);
  EXPECT_EQ(rig.sample(0).status, kDeviceOk) << rig.board().trouble(0).what;
}

TEST(ODriveDeadlines, HeartbeatThatStopsIsALostDriveThoughEstimatesGoOn) {
  ODriveCan drive({.node_id = 1, .heartbeat_lost_s = 0.035});
  CanOutbox outbox;
  drive.start(0);
  for (hal::TimeNs now_ns = kMs; now_ns < 50 * kMs; now_ns += kMs) {
    hal::CanReceived received;
    received.time_ns = now_ns;
    received.frame = frame_of(now_ns == kMs ? "021#0000000001000000" : "029#0000000000000000");
    drive.take(received);
    outbox.clear();
    drive.command(now_ns, {}, outbox);
    EXPECT_EQ((drive.sample().status & kDeviceLost) != 0, now_ns >= 36 * kMs) << now_ns;
  }
  EXPECT_EQ(drive.trouble().what, "the drive's heartbeat stopped");
}

TEST(ODriveRefusals, DriveThatIsNotCalibratedSaysSo) {
  for (const auto firmware : {host::ODriveFirmware::v0_5_6, host::ODriveFirmware::v0_6}) {
    CanRig<ODriveCan, host::ODriveEmulator> rig(
        {}, std::vector<ODriveConfig>{{}},
        std::vector<host::ODriveEmulatorConfig>{{.firmware = firmware, .calibrated = false}});
    rig.start();
    rig.command_all(0.1);
    rig.run(1500 * kMs);
    EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
    EXPECT_NE(rig.board().trouble(0).what.find("not calibrated"), std::string_view::npos)
        << rig.board().trouble(0).what;
    EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  }
}

TEST(ODriveRefusals, ClosedLoopForAMomentIsNotBelieved) {
  CanRig<ODriveCan, host::ODriveEmulator> rig(
      {}, std::vector<ODriveConfig>{{}},
      std::vector<host::ODriveEmulatorConfig>{{.heartbeat_ms = 10}});
  rig.start();
  rig.command_all(0.1);
  ASSERT_GT(rig.run_until(1000 * kMs, [&] { return rig.emulator(0).axis_state() == 8; }), 0);
  rig.run(100 * kMs);
  rig.emulator(0).drop_to_idle();
  rig.run(100 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceNotReady);
  EXPECT_EQ(rig.emulator(0).shaft().torque_Nm, 0.0);
  EXPECT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
}

TEST(ODriveRefusals, SilenceFromTheStartIsLostWithWhatToCheck) {
  CanRig<ODriveCan, host::ODriveEmulator> rig({}, std::vector<ODriveConfig>{{.node_id = 4}},
                                              std::vector<host::ODriveEmulatorConfig>{{}});
  rig.start();
  rig.run(2100 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceLost, 0U);
  EXPECT_NE(rig.board().trouble(0).remedy.find("node id"), std::string_view::npos);
}

TEST(ODriveRefusals, DriveWithoutEncoderMessagesIsToldHowToSendThem) {
  CanRig<ODriveCan, host::ODriveEmulator> rig(
      {}, std::vector<ODriveConfig>{{}},
      std::vector<host::ODriveEmulatorConfig>{{.encoder_ms = 0}});
  rig.start();
  rig.run(3000 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceLost, 0U);
  EXPECT_NE(rig.board().trouble(0).remedy.find("encoder message rate"), std::string_view::npos)
      << rig.board().trouble(0).what;
}

}  // namespace
}  // namespace tactus::drivers
