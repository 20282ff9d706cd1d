// Faults of a drive under torque: how long its torque lasts and what is reported.
#include <gtest/gtest.h>

#include <string_view>

#include "drivers/cia402_can/cia402_can.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using host::EmulatorFault;

// A drive that gives 0.2 N m.
class Cia402Faults : public ::testing::Test {
 protected:
  Cia402Faults()
      : rig_({}, std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
             std::vector<host::Cia402EmulatorConfig>{{}}) {
    rig_.rotor(0) = {.inertia_kg_m2 = 0.05, .damping_Nm_s = 0.01};
    rig_.start();
    rig_.command_all(0.2);
    EXPECT_GT(rig_.run_until_well(1000 * kMs), 0) << trouble().what;
    rig_.run(30 * kMs);
    EXPECT_NEAR(torque_Nm(), 0.2, 1e-9);
  }

  // Ticks until the torque is gone and the fault latched; both within `limit_ns`, or the test
  // fails.
  void expect_stopped_within(hal::TimeNs limit_ns, std::uint32_t bits) {
    const hal::TimeNs passed_ns =
        rig_.run_until(200 * kMs, [&] { return torque_Nm() == 0.0 && (status() & bits) != 0; });
    EXPECT_GT(passed_ns, 0) << status();
    EXPECT_LE(passed_ns, limit_ns);
    RecordProperty("stopped_after_us", static_cast<int>(passed_ns / kUs));
    expect_latched(bits);
  }
  void expect_latched(std::uint32_t bits) {
    EXPECT_NE(status() & bits, 0U) << status() << ' ' << trouble().what;
    EXPECT_EQ(torque_Nm(), 0.0);
    EXPECT_FALSE(trouble().what.empty());
    EXPECT_NE(trouble().remedy.find("reset"), std::string_view::npos) << trouble().remedy;
  }
  void expect_recovery() {
    rig_.emulator(0).set_fault(EmulatorFault::none);
    rig_.run(200 * kMs);
    EXPECT_NE(status(), kDeviceOk) << "not latched";
    EXPECT_EQ(torque_Nm(), 0.0);
    rig_.board().clear_faults();
    EXPECT_GT(rig_.run_until_well(1000 * kMs), 0) << trouble().what;
    rig_.run(30 * kMs);
    EXPECT_NEAR(torque_Nm(), 0.2, 1e-9);
  }
  bool says(std::string_view words) { return trouble().what.find(words) != std::string_view::npos; }

  std::uint32_t status() const { return rig_.sample(0).status; }
  double torque_Nm() { return rig_.emulator(0).shaft().torque_Nm; }
  Trouble trouble() { return rig_.board().trouble(0); }

  CanRig<Cia402Can, host::Cia402Emulator> rig_;
};

TEST_F(Cia402Faults, SilentDriveIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::silent);
  expect_stopped_within(5 * kMs, kDeviceLost);
  EXPECT_TRUE(says("no samples"));
  expect_recovery();
}

TEST_F(Cia402Faults, DelayedDriveIsStoppedInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::delayed);
  expect_stopped_within(5 * kMs, kDeviceLost);
  expect_recovery();
}

TEST_F(Cia402Faults, UnpluggedDriveIsLostInFiveMilliseconds) {
  rig_.emulator(0).set_fault(EmulatorFault::unplugged);
  expect_stopped_within(5 * kMs, kDeviceLost);
  expect_recovery();
}

// A flipped bit shows once it makes a position, a state or a mode that cannot be: on average in
// every other frame.
TEST_F(Cia402Faults, CorruptedDriveIsStoppedOnceItShows) {
  rig_.emulator(0).set_fault(EmulatorFault::corrupted);
  expect_stopped_within(20 * kMs, kDeviceEncoderFault | kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

TEST_F(Cia402Faults, ErringDriveIsToldWithItsCodeWithinTwoTicks) {
  rig_.emulator(0).set_fault(EmulatorFault::erroring);
  expect_stopped_within(2 * kMs, kDeviceDriveFault);
  EXPECT_EQ(trouble().code, 0x2310U);
  EXPECT_TRUE(says("over-current"));
  expect_recovery();
}

TEST_F(Cia402Faults, FaultThatPersistsKeepsItsWordsThroughAReset) {
  rig_.emulator(0).set_fault(EmulatorFault::erroring);
  rig_.run(10 * kMs);
  rig_.board().clear_faults();
  EXPECT_LT(rig_.run_until_well(5500 * kMs), 0);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(trouble().code, 0x2310U) << trouble().what;
  expect_recovery();
}

TEST_F(Cia402Faults, FaultWithoutAMessageIsAskedFor) {
  rig_.emulator(0).raise_fault(rig_.clock().now_ns(), 0x7305, false);
  expect_stopped_within(2 * kMs, kDeviceDriveFault);
  rig_.run(5 * kMs);
  EXPECT_EQ(trouble().code, 0x7305U);
  EXPECT_TRUE(says("encoder"));
  expect_recovery();
}

TEST_F(Cia402Faults, HeatIsToldApartHoweverTheHostLearnsOfIt) {
  for (const bool tells : {true, false}) {
    rig_.emulator(0).raise_fault(rig_.clock().now_ns(), 0x4310, tells);
    rig_.run(7 * kMs);
    expect_latched(kDeviceTooHot);
    expect_latched(kDeviceDriveFault);
    expect_recovery();
  }
}

TEST_F(Cia402Faults, HostThatFallsSilentLeavesNoTorque) {
  rig_.idle(25 * kMs);  // beyond the drive's watchdog of 20 ms
  EXPECT_EQ(torque_Nm(), 0.0);
  rig_.run(5 * kMs);
  expect_latched(kDeviceDriveFault);
  EXPECT_EQ(trouble().code, 0x8130U);
  expect_recovery();
}

TEST_F(Cia402Faults, HostThatOversleepsALittleBlamesNobody) {
  rig_.idle(10 * kMs);
  rig_.run(5 * kMs);
  EXPECT_EQ(status(), kDeviceOk) << trouble().what;
  EXPECT_NEAR(torque_Nm(), 0.2, 1e-9);
}

TEST_F(Cia402Faults, PowerThatGoesIsLatched) {
  rig_.emulator(0).set_motor_power(false);
  expect_stopped_within(2 * kMs, kDeviceDriveFault);
  rig_.emulator(0).set_motor_power(true);
  expect_recovery();
}

// The voltage stays on.
TEST_F(Cia402Faults, PowerThatTheDriveDropsWithoutAWordIsLatched) {
  rig_.emulator(0).drop_power();
  expect_stopped_within(2 * kMs, kDeviceDriveFault);
  EXPECT_EQ(status() & kDeviceReferenceLost, 0U);
  EXPECT_TRUE(says("switch on disabled"));
  expect_recovery();
}

TEST_F(Cia402Faults, PositionThatJumpsIsNeverReported) {
  const double before_rad = rig_.sample(0).position_rad;
  rig_.emulator(0).slip(1000);
  rig_.run(3 * kMs);
  expect_latched(kDeviceEncoderFault);
  EXPECT_NEAR(rig_.sample(0).position_rad, before_rad, 0.05);
  expect_recovery();
}

TEST_F(Cia402Faults, DriveThatRestartsIsLatched) {
  rig_.emulator(0).set_fault(EmulatorFault::unplugged);
  rig_.clock().advance_by(2 * host::kPowerLoss_ns);
  rig_.emulator(0).set_fault(EmulatorFault::none);
  rig_.idle(0);
  rig_.run(60 * kMs);
  expect_latched(kDeviceDriveFault | kDeviceLost);
  expect_recovery();
}

// The command that is on its way is lost with the SYNC.
TEST_F(Cia402Faults, OneLostSyncMakesOneOldSampleAndNoFault) {
  rig_.network().lose_next(2);
  int old_samples = 0;
  rig_.run(10 * kMs, [&](auto& samples, auto&) {
    EXPECT_EQ(samples[0].status, kDeviceOk) << trouble().what;
    old_samples += rig_.clock().now_ns() - samples[0].time_ns > kMs ? 1 : 0;
  });
  EXPECT_EQ(old_samples, 1);
}

// The tick waits for 100 us, the sample comes after 200.
TEST(Cia402Late, SamplesThatComeAfterTheirTickAreTold) {
  CanRig<Cia402Can, host::Cia402Emulator> rig({.patience_ns = 100 * kUs},
                                              std::vector<Cia402Config>{{.max_torque_Nm = 0.5}},
                                              std::vector<host::Cia402EmulatorConfig>{{}});
  rig.start();
  rig.run(500 * kMs);
  EXPECT_EQ(rig.sample(0).status & kDeviceLost, kDeviceLost);
  EXPECT_NE(rig.board().trouble(0).what.find("later than the tick"), std::string_view::npos)
      << rig.board().trouble(0).what;
}

TEST_F(Cia402Faults, LinkThatGoesDownIsLostAtOnce) {
  rig_.host().set_link_up(false);
  rig_.run(2 * kMs);
  EXPECT_NE(status() & kDeviceLost, 0U);
  EXPECT_TRUE(says("interface is down"));
  rig_.run(25 * kMs);
  EXPECT_EQ(torque_Nm(), 0.0);
  rig_.host().set_link_up(true);
  expect_recovery();
}

TEST_F(Cia402Faults, BusOffIsLostAndComesBackWithAReset) {
  rig_.host().force_bus_off();
  rig_.run(2 * kMs);
  EXPECT_NE(status() & kDeviceLost, 0U);
  rig_.run(25 * kMs);
  EXPECT_EQ(torque_Nm(), 0.0);
  expect_recovery();
}

}  // namespace
}  // namespace tactus::drivers
