// Three CiA 402 axes on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/cia402_can/cia402_can.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

// A virtual spring to a target that moves as a triangle; what reaches the plant is compared with
// what was commanded, and what was read with where the plant truly was at the SYNC.
TEST(Cia402Axes, ThreeAtOneKilohertzTrackAndDeliverTheirTorque) {
  std::vector<Cia402Config> drivers;
  std::vector<host::Cia402EmulatorConfig> drives;
  for (std::uint8_t i = 0; i < 3; ++i) {
    const auto node = static_cast<std::uint8_t>(i + 1);
    drivers.push_back(
        {.node = node, .leads_bus = i == 0, .counts_per_turn = 65536.0, .max_torque_Nm = 0.2});
    drives.push_back(
        {.node = node, .counts_per_turn = 65536.0, .rated_torque_Nm = 0.5, .rated_torque = 500});
  }
  CanRig<Cia402Can, host::Cia402Emulator> rig({}, drivers, drives);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);

  double worst_reading_rad = 0.0;
  double worst_torque_Nm = 0.0;
  double worst_tracking_rad = 0.0;
  hal::TimeNs oldest_ns = 0;
  std::array<double, 3> commanded_Nm{};
  int tick = 0;
  rig.run(1000 * kMs, [&](auto& samples, auto& commands) {
    const int phase = tick % 500;
    const double target_rad = 0.002 * (phase < 250 ? phase : 500 - phase);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(samples[i].status, kDeviceOk) << rig.board().trouble(i).what;
      const host::EmulatedShaft& shaft = rig.emulator(i).shaft();
      const hal::TimeNs age_ns = rig.clock().now_ns() - samples[i].time_ns;
      oldest_ns = std::max(oldest_ns, age_ns);
      const double truth_rad =
          shaft.position_rad - 1e-9 * static_cast<double>(age_ns) * shaft.velocity_rad_per_s;
      worst_reading_rad =
          std::max(worst_reading_rad, std::abs(samples[i].position_rad - truth_rad));
      if (tick > 20) {
        worst_torque_Nm = std::max(worst_torque_Nm, std::abs(shaft.torque_Nm - commanded_Nm[i]));
      }
      if (tick > 100) {
        worst_tracking_rad =
            std::max(worst_tracking_rad, std::abs(shaft.position_rad - target_rad));
      }
      const double torque_Nm = std::clamp(
          1.0 * (target_rad - samples[i].position_rad) - 0.012 * samples[i].velocity_rad_per_s,
          -0.2, 0.2);
      commands[i] = {.torque_Nm = torque_Nm, .enable = true};
      commanded_Nm[i] = torque_Nm;
    }
    ++tick;
  });
  EXPECT_TRUE(rig.are_well());
  EXPECT_LT(worst_reading_rad, 1e-3);      // the emulator's step of 50 us, and half a count
  EXPECT_LT(worst_torque_Nm, 0.00025001);  // half of 0.1 % of the rated torque
  EXPECT_LT(worst_tracking_rad, 0.05);
  EXPECT_LT(oldest_ns, 600 * kUs);
  RecordProperty("worst_reading_urad", static_cast<int>(1e6 * worst_reading_rad));
  RecordProperty("worst_tracking_mrad", static_cast<int>(1e3 * worst_tracking_rad));
  RecordProperty("oldest_sample_us", static_cast<int>(oldest_ns / kUs));
}

TEST(Cia402Axes, FaultOfOneLeavesTheOthersWell) {
  std::vector<Cia402Config> drivers;
  std::vector<host::Cia402EmulatorConfig> drives;
  for (std::uint8_t i = 0; i < 3; ++i) {
    const auto node = static_cast<std::uint8_t>(i + 1);
    drivers.push_back({.node = node, .leads_bus = i == 0, .max_torque_Nm = 0.2});
    drives.push_back({.node = node});
  }
  CanRig<Cia402Can, host::Cia402Emulator> rig({}, drivers, drives);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.command_all(0.0);
  rig.run(20 * kMs);
  rig.emulator(0).set_fault(host::EmulatorFault::unplugged);  // the one that leads
  rig.run(50 * kMs);
  EXPECT_EQ(rig.sample(0).status & kDeviceLost, kDeviceLost);
  EXPECT_EQ(rig.sample(1).status, kDeviceOk);
  EXPECT_EQ(rig.sample(2).status, kDeviceOk);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  bool others_well = true;
  rig.run(500 * kMs, [&](auto& samples, auto&) {
    others_well = others_well && samples[1].status == kDeviceOk && samples[2].status == kDeviceOk;
  });
  EXPECT_TRUE(others_well);
  EXPECT_TRUE(rig.are_well());
}

// The tick after a lost SYNC has samples of its own again, in every axis.
TEST(Cia402Axes, LostSyncCostsOneTickAndLeavesNoneBehind) {
  std::vector<Cia402Config> drivers;
  std::vector<host::Cia402EmulatorConfig> drives;
  for (std::uint8_t i = 0; i < 3; ++i) {
    const auto node = static_cast<std::uint8_t>(i + 1);
    // No heartbeat is among the frames that get lost.
    drivers.push_back(
        {.node = node, .leads_bus = i == 2, .max_torque_Nm = 0.2, .watchdog_ms = 400});
    drives.push_back({.node = node});
  }
  CanRig<Cia402Can, host::Cia402Emulator> rig({}, drivers, drives);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(5 * kMs);
  rig.network().lose_next(4);  // the commands on their way, and the SYNC
  int old_samples = 0;
  rig.run(50 * kMs, [&](auto& samples, auto&) {
    for (const AxisSample& sample : samples) {
      EXPECT_EQ(sample.status, kDeviceOk);
      old_samples += rig.clock().now_ns() - sample.time_ns >= kMs ? 1 : 0;
    }
  });
  EXPECT_EQ(old_samples, 3);
}

// Bring-up, torque, a fault of the drive, recovery and the orderly end, at 100 Hz to keep it short.
TEST(Cia402Axes, WholeSessionIsTheGoldenLog) {
  CanRig<Cia402Can, host::Cia402Emulator> rig(
      {.period_ns = 10 * kMs, .patience_ns = kMs, .record = true},
      std::vector<Cia402Config>{{.node = 5,
                                 .period_s = 0.01,
                                 .max_torque_Nm = 0.5,
                                 .watchdog_ms = 200,
                                 .drive_heartbeat_ms = 100,
                                 .lost_after_s = 0.03}},
      std::vector<host::Cia402EmulatorConfig>{{.node = 5}});
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  rig.command_all(0.125);
  ASSERT_GT(rig.run_until_well(2000 * kMs), 0);
  rig.run(100 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.125, 1e-9);
  rig.emulator(0).set_fault(host::EmulatorFault::erroring);
  rig.run(50 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(2000 * kMs), 0);
  rig.run(50 * kMs);
  rig.board().stop();
  rig.run(20 * kMs);
  EXPECT_TRUE(is_golden("cia402", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
