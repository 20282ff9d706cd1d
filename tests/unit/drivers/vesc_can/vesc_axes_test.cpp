// Three VESCs on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <vector>

#include "drivers/vesc_can/vesc_can.h"
#include "host_tools/emulators/vesc_emulator.h"
#include "tests/unit/drivers/axes_on_one_bus.h"
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

  const TrackingErrors worst = track_a_triangle(rig, {.drives_read = false});
  EXPECT_LT(worst.torque_Nm, 0.5e-3 * 0.03 + 1e-9);  // half a milliampere
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
  live_through_a_session(rig, 0.075, 100 * kMs);
  EXPECT_TRUE(is_golden("vesc", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
