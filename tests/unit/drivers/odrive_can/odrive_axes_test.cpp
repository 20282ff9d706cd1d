// Three ODrive axes on one bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/odrive_can/odrive_can.h"
#include "host_tools/emulators/odrive_emulator.h"
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
      const double age_s = 1e-9 * static_cast<double>(rig.clock().now_ns() - samples[i].time_ns);
      oldest_ns = std::max(oldest_ns, rig.clock().now_ns() - samples[i].time_ns);
      const double truth_rad = shaft.position_rad - age_s * shaft.velocity_rad_per_s;
      worst_reading_rad =
          std::max(worst_reading_rad, std::abs(samples[i].position_rad - truth_rad));
      if (tick > 0) {
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
  EXPECT_LT(worst_reading_rad, 3e-3);  // what the shaft turns while the frame waits and travels
  EXPECT_LT(worst_torque_Nm, 1e-7);    // single precision
  EXPECT_LT(worst_tracking_rad, 0.05);
  EXPECT_LT(oldest_ns, 2 * kMs);
  RecordProperty("worst_reading_urad", static_cast<int>(1e6 * worst_reading_rad));
  RecordProperty("worst_tracking_mrad", static_cast<int>(1e3 * worst_tracking_rad));
  RecordProperty("oldest_sample_us", static_cast<int>(oldest_ns / kUs));
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
    rig.start();
    rig.command_all(0.125);
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    rig.run(100 * kMs);
    rig.emulator(0).set_fault(host::EmulatorFault::erroring);
    rig.run(150 * kMs);
    EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
    rig.emulator(0).set_fault(host::EmulatorFault::none);
    rig.board().clear_faults();
    ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    rig.run(50 * kMs);
    rig.board().stop();
    rig.run(20 * kMs);
    EXPECT_TRUE(is_golden(is_0_6 ? "odrive_0_6" : "odrive_0_5", rig.log()));
  }
}

}  // namespace
}  // namespace tactus::drivers
