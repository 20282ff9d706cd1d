// Three moteus servos on one CAN FD bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/moteus_canfd/moteus_canfd.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {
namespace {

// A virtual spring to a target that moves as a triangle; what reaches the plant is compared with
// what was commanded, and what was read with where the plant truly was.
TEST(MoteusAxes, ThreeAtOneKilohertzTrackAndDeliverTheirTorque) {
  for (const MoteusQuery query : {MoteusQuery::with_command, MoteusQuery::before_command}) {
    std::vector<MoteusConfig> drivers;
    std::vector<host::MoteusEmulatorConfig> emulators;
    for (std::uint8_t id = 1; id <= 3; ++id) {
      drivers.push_back({.servo_id = id, .max_torque_Nm = 0.2, .query = query});
      emulators.push_back({.servo_id = id});
    }
    CanRig<MoteusCanFd, host::MoteusEmulator> rig(
        {.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000}}, drivers,
        emulators);
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
  }
}

// Bring-up, torque, a fault of the servo, recovery and the orderly end, at 100 Hz to keep it short.
TEST(MoteusAxes, WholeSessionIsTheGoldenLog) {
  CanRig<MoteusCanFd, host::MoteusEmulator> rig(
      {.network = {.fd = true, .bit_rate = 1'000'000, .data_bit_rate = 5'000'000},
       .period_ns = 10 * kMs,
       .patience_ns = kMs,
       .record = true},
      std::vector<MoteusConfig>{{.watchdog_s = 0.1, .reply_stale_s = 0.025, .reply_lost_s = 0.045}},
      std::vector<host::MoteusEmulatorConfig>{{.start_s = 0.05}});
  rig.start();
  rig.command_all(0.125);
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(100 * kMs);
  rig.emulator(0).set_fault(host::EmulatorFault::erroring);
  rig.run(100 * kMs);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
  rig.run(50 * kMs);
  rig.board().stop();
  rig.run(20 * kMs);
  EXPECT_TRUE(is_golden("moteus", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
