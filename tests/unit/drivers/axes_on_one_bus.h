// Two tests that every drive on a CAN bus passes: three axes that follow a target, and a session.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "tests/unit/drivers/can_rig.h"

namespace tactus::drivers {

struct TrackingPlan {
  int torque_from_tick = 1;  // the first tick whose torque is compared
  // False for torque amplifiers: another encoder closes the spring, here the shaft's true motion.
  bool drives_read = true;
};

// The largest errors of a run, over all axes.
struct TrackingErrors {
  double reading_rad = 0.0;   // sample less true position at the sample's time
  double torque_Nm = 0.0;     // torque of the plant less the command of the tick before
  double tracking_rad = 0.0;  // true position less target, after 100 ticks
  hal::TimeNs oldest_ns = 0;  // age of a sample
};

// Lets virtual springs of three axes follow a target that moves as a triangle, for a second.
template <class Rig>
TrackingErrors track_a_triangle(Rig& rig, const TrackingPlan& plan = {}) {
  constexpr double kLimit_Nm = 0.2;
  TrackingErrors worst;
  std::array<double, 3> commanded_Nm{};
  int tick = 0;
  rig.run(1000 * kMs, [&](auto& samples, auto& commands) {
    const int phase = tick % 500;
    const double target_rad = 0.002 * (phase < 250 ? phase : 500 - phase);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t allowed = plan.drives_read ? std::uint32_t{kDeviceOk} : kDeviceStale;
      ASSERT_EQ(samples[i].status & ~allowed, kDeviceOk) << rig.board().trouble(i).what;
      const host::EmulatedShaft& shaft = rig.emulator(i).shaft();
      const hal::TimeNs age_ns = rig.clock().now_ns() - samples[i].time_ns;
      worst.oldest_ns = std::max(worst.oldest_ns, age_ns);
      const double truth_rad =
          shaft.position_rad - 1e-9 * static_cast<double>(age_ns) * shaft.velocity_rad_per_s;
      worst.reading_rad =
          std::max(worst.reading_rad, std::abs(samples[i].position_rad - truth_rad));
      if (tick >= plan.torque_from_tick) {
        worst.torque_Nm = std::max(worst.torque_Nm, std::abs(shaft.torque_Nm - commanded_Nm[i]));
      }
      if (tick > 100) {
        worst.tracking_rad =
            std::max(worst.tracking_rad, std::abs(shaft.position_rad - target_rad));
      }
      const double at_rad = plan.drives_read ? samples[i].position_rad : shaft.position_rad;
      const double speed_rad_per_s =
          plan.drives_read ? samples[i].velocity_rad_per_s : shaft.velocity_rad_per_s;
      const double torque_Nm =
          std::clamp(1.0 * (target_rad - at_rad) - 0.012 * speed_rad_per_s, -kLimit_Nm, kLimit_Nm);
      commands[i] = {.torque_Nm = torque_Nm, .enable = true};
      commanded_Nm[i] = torque_Nm;
    }
    ++tick;
  });
  EXPECT_LT(worst.tracking_rad, 0.05);
  ::testing::Test::RecordProperty("worst_reading_urad", static_cast<int>(1e6 * worst.reading_rad));
  ::testing::Test::RecordProperty("worst_tracking_mrad",
                                  static_cast<int>(1e3 * worst.tracking_rad));
  ::testing::Test::RecordProperty("oldest_sample_us", static_cast<int>(worst.oldest_ns / kUs));
  return worst;
}

// Brings up one axis, gives a torque, lets the drive fail for `fault_ns`, recovers and stops.
template <class Rig>
void live_through_a_session(Rig& rig, double torque_Nm, hal::TimeNs fault_ns) {
  rig.start();
  rig.command_all(torque_Nm);
  ASSERT_GT(rig.run_until_well(2000 * kMs), 0);
  rig.run(100 * kMs);
  EXPECT_NEAR(rig.emulator(0).shaft().torque_Nm, torque_Nm, 1e-9);
  rig.emulator(0).set_fault(host::EmulatorFault::erroring);
  rig.run(fault_ns);
  EXPECT_NE(rig.sample(0).status & kDeviceDriveFault, 0U);
  rig.emulator(0).set_fault(host::EmulatorFault::none);
  rig.board().clear_faults();
  ASSERT_GT(rig.run_until_well(2000 * kMs), 0) << rig.board().trouble(0).what;
  rig.run(50 * kMs);
  rig.board().stop();
  rig.run(20 * kMs);
}

}  // namespace tactus::drivers
