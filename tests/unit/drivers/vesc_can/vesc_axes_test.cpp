// Three VESCs on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/vesc_can/vesc_can.h"
#include "host_tools/emulators/vesc_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

// Torque amplifiers under a virtual spring that another encoder closes: what reaches the plant is
// compared with what was commanded a tick before.
TEST(VescAxes, ThreeAtOneKilohertzDeliverTheirTorque) {
  std::vector<VescConfig> drivers;
  std::vector<host::VescEmulatorConfig> drives;
  for (std::uint8_t i = 0; i < 3; ++i) {
    drivers.push_back({.vesc_id = i, .torque_constant_Nm_per_A = 0.03, .max_torque_Nm = 0.2});
    drives.push_back({.vesc_id = i});
  }
  CanRig<VescCan, host::VescEmulator> rig({}, drivers, drives);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);

  double worst_torque_Nm = 0.0;
  double worst_tracking_rad = 0.0;
  std::array<double, 3> commanded_Nm{};
  int tick = 0;
  rig.run(1000 * kMs, [&](auto& samples, auto& commands) {
    const int phase = tick % 500;
    const double target_rad = 0.002 * (phase < 250 ? phase : 500 - phase);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(samples[i].status & ~std::uint32_t{kDeviceStale}, kDeviceOk)
          << rig.board().trouble(i).what;
      const host::EmulatedShaft& shaft = rig.emulator(i).shaft();
      if (tick > 0) {
        worst_torque_Nm = std::max(worst_torque_Nm, std::abs(shaft.torque_Nm - commanded_Nm[i]));
      }
      if (tick > 100) {
        worst_tracking_rad =
            std::max(worst_tracking_rad, std::abs(shaft.position_rad - target_rad));
      }
      const double torque_Nm = std::clamp(
          1.0 * (target_rad - shaft.position_rad) - 0.012 * shaft.velocity_rad_per_s, -0.2, 0.2);
      commands[i] = {.torque_Nm = torque_Nm, .enable = true};
      commanded_Nm[i] = torque_Nm;
    }
    ++tick;
  });
  EXPECT_LT(worst_torque_Nm, 0.5e-3 * 0.03 + 1e-9);  // half a milliampere
  EXPECT_LT(worst_tracking_rad, 0.05);
  RecordProperty("worst_tracking_mrad", static_cast<int>(1e3 * worst_tracking_rad));
}

// Bring-up, torque, a fault of the VESC, recovery and the orderly end, at 100 Hz to keep it short.
TEST(VescAxes, WholeSessionIsTheGoldenLog) {
  CanRig<VescCan, host::VescEmulator> rig(
      {.period_ns = 10 * kMs, .record = true},
      std::vector<VescConfig>{{.vesc_id = 23,
                               .torque_constant_Nm_per_A = 0.05,
                               .max_torque_Nm = 0.5,
                               .offers_position = true,
                               .status_period_s = 0.02,
                               .lost_after_s = 0.06,
                               .poll_period_s = 0.03}},
      std::vector<host::VescEmulatorConfig>{{.vesc_id = 23,
                                             .torque_constant_Nm_per_A = 0.05,
                                             .fault_stop_ns = 100 * kMs,
                                             .status_period_ns = 20 * kMs}});
  rig.rotor(0).inertia_kg_m2 = 0.05;
  rig.start();
  rig.command_all(0.075);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(100 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, 0.075, 1e-9);
  rig.emulator(0).set_fault(host::EmulatorFault::erroring);
  rig.run(100 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0) << rig.board().trouble(0).what;
  rig.run(50 * kMs);
  rig.board().stop();
  rig.run(20 * kMs);
  EXPECT_TRUE(is_golden("vesc", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
