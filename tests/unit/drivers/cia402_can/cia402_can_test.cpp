// The driver against an emulated drive: bring-up, refusals, torque, position.
#include "drivers/cia402_can/cia402_can.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

using Cia402Rig = CanRig<Cia402Can, host::Cia402Emulator>;

constexpr hal::TimeNs kBringUp_ns = 1000 * kMs;

Cia402Rig one_drive(const Cia402Config& driver = {.max_torque_Nm = 0.5},
                    const host::Cia402EmulatorConfig& drive = {}) {
  return Cia402Rig({}, std::vector{driver}, std::vector{drive});
}

std::size_t count_of(const std::vector<std::string>& log, const std::string& frame) {
  return static_cast<std::size_t>(
      std::ranges::count_if(log, [&](const std::string& line) { return line.ends_with(frame); }));
}

TEST(Cia402Can, HealthyDriveIsReadyWithoutPower) {
  Cia402Rig rig = one_drive();
  rig.start();
  EXPECT_EQ(rig.driver(0).sample().status, kDeviceNotReady);
  EXPECT_GT(rig.run_until_well(kBringUp_ns), 0) << rig.board().trouble(0).what;
  EXPECT_EQ(rig.emulator(0).statusword() & 0x6FU, 0x21U);
  EXPECT_EQ(rig.driver(0).facts().vendor, 0x5441U);
  EXPECT_DOUBLE_EQ(rig.driver(0).facts().rated_torque_Nm, 1.0);
  EXPECT_EQ(rig.driver(0).facts().torque_limit, 500);
}

TEST(Cia402Can, PowerFollowsTheCommand) {
  Cia402Rig rig = one_drive();
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  rig.command_all(0.0);
  rig.run(10 * kMs);
  EXPECT_EQ(rig.emulator(0).statusword() & 0x6FU, 0x27U);
  rig.run(2 * kMs, [](auto&, auto& commands) { commands[0].enable = false; });
  rig.run(2 * kMs);
  EXPECT_EQ(rig.emulator(0).statusword() & 0x6FU, 0x21U);
  EXPECT_EQ(rig.sample(0).status, kDeviceOk);
}

// Off and on again at once: what the drive did before it heard of it is no fault.
TEST(Cia402Can, PowerMayBeTakenAndWantedInAnyRhythm) {
  Cia402Rig rig = one_drive();
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  int tick = 0;
  rig.run(300 * kMs, [&](auto& samples, auto& commands) {
    ASSERT_EQ(samples[0].status, kDeviceOk) << rig.board().trouble(0).what;
    commands[0] = {.torque_Nm = 0.01, .enable = tick * tick % 11 < 6};
    ++tick;
  });
}

TEST(Cia402Can, TorqueIsTheRatedTorquesShare) {
  // 0.25 N m of a motor of 0.4 N m are 62.5 %.
  Cia402Rig rig = one_drive({.max_torque_Nm = 0.3}, {.rated_torque_Nm = 0.4, .rated_torque = 400});
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  rig.command_all(-0.25);
  rig.run(20 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, -0.25, 1e-9);
  EXPECT_NEAR(rig.sample(0).torque_Nm, -0.25, 1e-9);
}

TEST(Cia402Can, TorqueBeyondTheLimitIsClampedAndNoNumberIsNone) {
  Cia402Rig rig = one_drive({.max_torque_Nm = 0.1234});
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  for (const double wild_Nm : {1e9, -1e9, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    rig.command_all(wild_Nm);
    rig.run(20 * kMs);
    const double expected_Nm = std::isfinite(wild_Nm) ? std::copysign(0.123, wild_Nm) : 0.0;
    EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, expected_Nm, 1e-9) << wild_Nm;
  }
  // The drive holds the same limit, whoever commands it.
  EXPECT_EQ(rig.emulator(0).statusword() & 0x0800U, 0U);
}

TEST(Cia402Can, DriveThatCountsMicroNewtonMetresIsReadSo) {
  Cia402Rig rig = one_drive({.max_torque_Nm = 0.05, .rated_torque_from = RatedTorque::drive_uNm},
                            {.rated_torque_Nm = 0.1, .rated_torque = 100'000});
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  rig.command_all(0.02);
  rig.run(20 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.02, 1e-9);
}

TEST(Cia402Can, RatedTorqueInTheWrongUnitIsFoundOut) {
  // 0.1 N m in uN m, and another motor's 0.2 N m.
  for (const std::uint32_t rated : {100'000U, 200U}) {
    Cia402Rig rig = one_drive({.max_torque_Nm = 0.05, .rated_torque_Nm = 0.1},
                              {.rated_torque_Nm = 0.1, .rated_torque = rated});
    rig.start();
    EXPECT_LT(rig.run_until_well(200 * kMs), 0) << rated;
    EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault) << rated;
    EXPECT_EQ(rig.board().trouble(0).code, rated);
    EXPECT_NE(rig.board().trouble(0).remedy.find("unit"), std::string_view::npos) << rated;
  }
}

TEST(Cia402Can, ConfiguredRatedTorqueStandsWhateverTheDriveSays) {
  Cia402Rig rig = one_drive(
      {.max_torque_Nm = 0.05, .rated_torque_from = RatedTorque::configured, .rated_torque_Nm = 0.1},
      {.rated_torque_Nm = 0.1, .rated_torque = 77});
  rig.emulator(0).remove_object(0x6076, 0);
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  rig.command_all(0.04);
  rig.run(20 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.04, 1e-9);
}

TEST(Cia402Can, DriveWithoutTheOptionalObjectsComesUp) {
  Cia402Rig rig = one_drive();
  for (const std::uint16_t index :
       std::to_array<std::uint16_t>({0x60E0, 0x60E1, 0x6007, 0x605E, 0x1018})) {
    for (std::uint8_t sub = 0; sub < 3; ++sub) {
      rig.emulator(0).remove_object(index, sub);
    }
  }
  rig.emulator(0).remove_object(0x60C2, 1);
  rig.emulator(0).remove_object(0x60C2, 2);
  rig.start();
  EXPECT_GT(rig.run_until_well(kBringUp_ns), 0) << rig.board().trouble(0).what;
}

TEST(Cia402Can, RefusedSetUpNamesTheObjectAndTheReason) {
  Cia402Rig rig = one_drive();
  rig.emulator(0).remove_object(0x6072, 0);
  rig.start();
  EXPECT_LT(rig.run_until_well(200 * kMs), 0);
  EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault);
  const Trouble trouble = rig.board().trouble(0);
  EXPECT_NE(trouble.what.find("6072:00"), std::string_view::npos);
  EXPECT_NE(trouble.remedy.find("no such object"), std::string_view::npos);
  EXPECT_EQ(trouble.code, 0x0602'0000U);
}

TEST(Cia402Can, WhatIsNoTorqueDriveIsRefused) {
  for (const auto& [index, value] :
       {std::pair<std::uint16_t, std::uint32_t>{0x6502, 0xA5}, {0x6076, 0}}) {
    Cia402Rig rig = one_drive();
    rig.emulator(0).set_object(index, 0, value);
    rig.start();
    EXPECT_LT(rig.run_until_well(200 * kMs), 0);
    EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault);
    EXPECT_TRUE(rig.board().trouble(0));
    EXPECT_EQ(rig.board().trouble(0).code, value);
  }
}

TEST(Cia402Can, AbsentDriveIsLostWithWordsAndFoundLater) {
  Cia402Rig rig = one_drive({.max_torque_Nm = 0.5, .bring_up_timeout_s = 0.5});
  rig.emulator(0).set_fault(host::EmulatorFault::unplugged);
  rig.start();
  rig.run(450 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceNotReady);
  rig.run(100 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceLost);
  EXPECT_NE(rig.board().trouble(0).what.find("does not boot up"), std::string_view::npos);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  EXPECT_GT(rig.run_until_well(kBringUp_ns), 0) << rig.board().trouble(0).what;
}

TEST(Cia402Can, BusWithoutALeaderIsToldSo) {
  Cia402Rig rig = one_drive({.leads_bus = false, .max_torque_Nm = 0.5, .bring_up_timeout_s = 0.5});
  rig.start();
  rig.run(600 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceLost);
  EXPECT_NE(rig.board().trouble(0).remedy.find("leads_bus"), std::string_view::npos);
}

TEST(Cia402Can, MissingMotorPowerIsTold) {
  Cia402Rig rig = one_drive({.max_torque_Nm = 0.5, .bring_up_timeout_s = 0.5});
  rig.emulator(0).set_motor_power(false);
  rig.start();
  rig.run(600 * kMs);
  EXPECT_EQ(rig.sample(0).status, kDeviceDriveFault);
  EXPECT_NE(rig.board().trouble(0).remedy.find("motor power"), std::string_view::npos);
}

TEST(Cia402Can, FaultFromBeforeIsResetInTheBringUp) {
  Cia402Rig rig = one_drive();
  rig.emulator(0).raise_fault(0, 0x3210);
  rig.start();
  EXPECT_GT(rig.run_until_well(kBringUp_ns), 0) << rig.board().trouble(0).what;
}

TEST(Cia402Can, PositionRunsOnWhereTheCounterWraps) {
  Cia402Rig rig =
      one_drive({.max_torque_Nm = 0.5},
                {.first_count = std::int64_t{std::numeric_limits<std::int32_t>::max()} - 100});
  rig.emulator(0).shaft().velocity_rad_per_s = 50.0;
  rig.rotor(0).damping_Nm_s = 0.0;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  const double first_rad = rig.sample(0).position_rad - rig.emulator(0).shaft().position_rad;
  rig.run(500 * kMs, [&](auto& samples, auto&) {
    ASSERT_EQ(samples[0].status, kDeviceOk) << rig.board().trouble(0).what;
  });
  EXPECT_GT(rig.emulator(0).shaft().position_rad, 100.0 * 2.0 * std::numbers::pi / 4096.0);
  EXPECT_NEAR(rig.sample(0).position_rad - rig.emulator(0).shaft().position_rad, first_rad,
              50.0 * 0.002);
  EXPECT_NEAR(rig.sample(0).velocity_rad_per_s, 50.0, 1.6);  // a count a millisecond
}

TEST(Cia402Can, VelocityOfTheDriveIsReadInItsUnit) {
  Cia402Rig rig =
      one_drive({.max_torque_Nm = 0.5, .velocity_unit_rad_per_s = 2.0 * std::numbers::pi / 4096.0});
  rig.emulator(0).shaft().velocity_rad_per_s = -20.0;
  rig.rotor(0).damping_Nm_s = 0.0;
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  EXPECT_NEAR(rig.sample(0).velocity_rad_per_s, -20.0, 1e-3);
}

TEST(Cia402Can, TorqueOnReceiptActsWithinTheTick) {
  for (const bool on_receipt : {false, true}) {
    Cia402Rig rig = one_drive({.max_torque_Nm = 0.5, .torque_on_receipt = on_receipt});
    rig.rotor(0).inertia_kg_m2 = 0.05;
    rig.start();
    ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
    rig.command_all(0.0);
    rig.run(20 * kMs);
    rig.command_all(0.1);
    rig.run(kMs);
    rig.clock().advance_by(500 * kUs);
    EXPECT_EQ(rig.emulator(0).shaft().torque_Nm != 0.0, on_receipt);
    rig.run(2 * kMs);
    EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.1, 1e-9);
  }
}

TEST(Cia402Can, OrderlyEndTakesTorqueAndPowerWithoutAnotherSync) {
  std::vector<Cia402Config> drivers{{.node = 1, .max_torque_Nm = 0.5},
                                    {.node = 2, .leads_bus = false, .max_torque_Nm = 0.5}};
  Cia402Rig rig({}, drivers, std::vector<host::Cia402EmulatorConfig>{{.node = 1}, {.node = 2}});
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  rig.command_all(0.1);
  rig.run(20 * kMs);
  rig.board().stop();
  rig.clock().advance_by(2 * kMs);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(rig.emulator(i).shaft().torque_Nm, 0.0);
    EXPECT_EQ(rig.emulator(i).statusword() & 0x6FU, 0x40U);
  }
  rig.board().start();
  EXPECT_GT(rig.run_until_well(kBringUp_ns), 0);
}

TEST(Cia402Can, OneSyncATickForTheWholeBusAndAHeartbeatOfItsOwnForEachDrive) {
  std::vector<Cia402Config> drivers;
  std::vector<host::Cia402EmulatorConfig> drives;
  for (std::uint8_t i = 0; i < 3; ++i) {
    drivers.push_back(
        {.node = static_cast<std::uint8_t>(i + 1), .leads_bus = i == 1, .max_torque_Nm = 0.5});
    drives.push_back({.node = static_cast<std::uint8_t>(i + 1)});
  }
  ASSERT_TRUE(check_bus(drivers));
  Cia402Rig rig({.record = true}, drivers, drives);
  rig.start();
  ASSERT_GT(rig.run_until_well(kBringUp_ns), 0);
  const std::vector<std::string> before = rig.log();
  const auto since = [&](const char* frame) {
    return static_cast<double>(count_of(rig.log(), frame) - count_of(before, frame));
  };
  rig.run(200 * kMs);
  EXPECT_EQ(since("080#"), 200.0);
  for (const char* heartbeat : {"77F#05", "77E#05", "77D#05"}) {
    EXPECT_NEAR(since(heartbeat), 200.0 / 5.0, 1.0) << heartbeat;
  }
}

}  // namespace
}  // namespace tactus::drivers
