// Three moteus servos on one CAN FD bus at 1 kHz, and a whole session as a log.

#include <gtest/gtest.h>

#include <vector>

#include "drivers/moteus_canfd/moteus_canfd.h"
#include "host_tools/emulators/moteus_emulator.h"
#include "tests/unit/drivers/axes_on_one_bus.h"
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

    const TrackingErrors worst = track_a_triangle(rig);
    EXPECT_TRUE(rig.are_well());
    EXPECT_LT(worst.reading_rad, 3e-3);  // what the shaft turns while the frame waits and travels
    EXPECT_LT(worst.torque_Nm, 1e-7);    // single precision
    EXPECT_LT(worst.oldest_ns, 2 * kMs);
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
  live_through_a_session(rig, 0.125, 100 * kMs);
  EXPECT_TRUE(is_golden("moteus", rig.log()));
}

}  // namespace
}  // namespace tactus::drivers
