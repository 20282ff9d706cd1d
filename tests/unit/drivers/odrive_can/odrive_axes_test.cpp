// Three ODrive axes on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <vector>

#include "drivers/odrive_can/odrive_can.h"
#include "host_tools/emulators/odrive_emulator.h"
#include "tests/unit/drivers/axes_on_one_bus.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

// A virtual spring to a target that moves as a triangle; what reaches the plant is compared with
// what was commanded, and what was read with where the plant truly was.
TEST(ODriveAxes, ThreeAtOneKilohertzTrackAndDeliverTheirTorque) {
  std::vector<ODriveConfig> drivers;
  std::vector<host::ODriveEmulatorConfig> emulators;
  for (std::uint8_t i = 0; i < 3; ++i) {
    drivers.push_back({.node_id = i, .max_torque_Nm = 0.2});
    emulators.push_back({.node_id = i, .heartbeat_ms = 10});
  }
  emulators[1].firmware = host::ODriveFirmware::v0_5_6;
  CanRig<ODriveCan, host::ODriveEmulator> rig({}, drivers, emulators);
  rig.start();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);

  const TrackingErrors worst = track_a_triangle(rig);
  EXPECT_TRUE(rig.are_well());
  EXPECT_LT(worst.reading_rad, 3e-3);  // what the shaft turns while the frame waits and travels
  EXPECT_LT(worst.torque_Nm, 1e-7);    // single precision
  EXPECT_LT(worst.oldest_ns, 2 * kMs);
}

// Bring-up, torque, a fault of the drive, recovery and the orderly end, at 100 Hz to keep it short.
TEST(ODriveAxes, WholeSessionIsTheGoldenLog) {
  for (const bool is_0_6 : {false, true}) {
    CanRig<ODriveCan, host::ODriveEmulator> rig(
        {.period_ns = 10 * kMs, .patience_ns = kMs, .record = true},
        std::vector<ODriveConfig>{{.node_id = 1,
                                   .watchdog_s = 0.1,
                                   .estimate_stale_s = 0.025,
                                   .estimate_lost_s = 0.045,
                                   .heartbeat_lost_s = 0.15}},
        std::vector<host::ODriveEmulatorConfig>{
            {.node_id = 1,
             .firmware = is_0_6 ? host::ODriveFirmware::v0_6 : host::ODriveFirmware::v0_5_6,
             .heartbeat_ms = 50,
             .encoder_ms = 10,
             .watchdog_s = 0.1}});
    live_through_a_session(rig, 0.125, 150 * kMs);
    EXPECT_TRUE(is_golden(is_0_6 ? "odrive_0_6" : "odrive_0_5", rig.log()));
  }
}

}  // namespace
}  // namespace tactus::drivers
