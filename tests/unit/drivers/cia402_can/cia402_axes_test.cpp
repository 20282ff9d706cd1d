// Three CiA 402 axes on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <vector>

#include "drivers/cia402_can/cia402_can.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/axes_on_one_bus.h"
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

  const TrackingErrors worst = track_a_triangle(rig, {.torque_from_tick = 21});
  EXPECT_TRUE(rig.are_well());
  EXPECT_LT(worst.reading_rad, 1e-3);      // the emulator's step of 50 us, and half a count
  EXPECT_LT(worst.torque_Nm, 0.00025001);  // half of 0.1 % of the rated torque
  EXPECT_LT(worst.oldest_ns, 600 * kUs);
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
  live_through_a_session(rig, 0.125, 50 * kMs);
  EXPECT_TRUE(is_golden("cia402", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
