#include "firmware/safety/effort_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

class EffortGuardTest : public ::testing::Test {
 protected:
  EffortGuardTest() {
    guard_.configure(cartesian_config());  // 1 kHz, 10 N
    pose_.jacobian_D.setIdentity();
    pose_.status = kPoseGood;
  }

  // The first tick in which a drive that measures `gain` times the commanded 5 N of joint 1, every
  // `period` ticks, is found, or 0.
  int found_after(double gain, std::uint32_t known, int period = 1) {
    drivers::JointSample sample;
    sample.effort_known = known;
    for (int tick = 1; tick <= 2000; ++tick) {
      sample.effort[1] = gain * 5.0;
      sample.effort_is_new = tick % period == 0 ? known : 0;
      last_ = guard_.check(sample, pose_, {0.0, 5.0, 0.0});
      if (last_.faults != kNoFault) {
        return tick;
      }
    }
    return 0;
  }

  // A mass that a spring of 1000 N/m in the motor pushes, with a sign, from 0.05 m/s on; a hand
  // of 300 N/m and 5 N s/m wants to stay where the surface begins.
  int pressed(double sign, double mass_kg) {
    double depth_m = 0.0;
    double speed_m_per_s = 0.05;
    for (int tick = 1; tick <= 300; ++tick) {
      const double effort = depth_m > 0.0 ? 1000.0 * depth_m : 0.0;  // out of the surface
      drivers::JointSample sample;
      sample.velocity[2] = -speed_m_per_s;
      last_ = guard_.check(sample, pose_, {0.0, 0.0, effort});
      if (last_.faults != kNoFault) {
        return tick;
      }
      const double push_N = -sign * effort - 300.0 * depth_m - 5.0 * speed_m_per_s;
      speed_m_per_s += 0.001 * push_N / mass_kg;
      depth_m += 0.001 * speed_m_per_s;
    }
    return 0;
  }

  EffortGuard guard_;
  Pose pose_;
  EffortFinding last_;
};

TEST_F(EffortGuardTest, MeasuredEffortFarFromTheCommandedOneIsFoundWithinFiftyTicks) {
  for (const double gain : {-1.0, 0.0, 1.0 / 3.0, 3.0}) {
    guard_.rest();
    const int tick = found_after(gain, 0b010);
    EXPECT_GT(tick, 10) << gain;
    EXPECT_LE(tick, 50) << gain;
    EXPECT_EQ(last_.faults, kFaultEffortMismatch) << gain;
    EXPECT_EQ(last_.joint, 2U) << gain;
  }
}

TEST_F(EffortGuardTest, AMeasurementThatIsNotANumberAgreesWithNothing) {
  EXPECT_GT(found_after(std::numeric_limits<double>::quiet_NaN(), 0b010), 0);
}

TEST_F(EffortGuardTest, ADriveThatMeasuresNothingOrNearlyRightIsLeftAlone) {
  EXPECT_EQ(found_after(-1.0, 0b101), 0);
  for (const double gain : {0.8, 1.0, 1.2}) {
    guard_.rest();
    EXPECT_EQ(found_after(gain, 0b111), 0) << gain;
  }
}

TEST_F(EffortGuardTest, ADriveThatMeasuresSeldomIsFoundWithItsSecondWrongMeasurement) {
  EXPECT_EQ(found_after(-1.0, 0b010, 10), 20);
  guard_.rest();
  EXPECT_EQ(found_after(-1.0, 0b010, 500), 1000);
  guard_.rest();
  EXPECT_EQ(found_after(1.0, 0b010, 500), 0);
}

TEST_F(EffortGuardTest, AMeasurementCountsOnce) {
  drivers::JointSample sample;
  sample.effort_known = 0b010;
  sample.effort[1] = -5.0;
  for (int tick = 1; tick <= 2000; ++tick) {
    sample.effort_is_new = tick == 100 ? 0b010 : 0;
    EXPECT_EQ(guard_.check(sample, pose_, {0.0, 5.0, 0.0}).faults, kNoFault) << tick;
  }
}

// Drives at fault-free work: each measures with its own period the mean of the torque over its own
// time, its own time ago. The commands are the hardest that there are: from limit to limit, for
// random times.
TEST_F(EffortGuardTest, AMeasurementThatIsLateOrSmoothedIsNoMismatch) {
  std::mt19937 random(7);
  for (const double rate_hz : {100.0, 500.0, 1000.0, 4000.0}) {
    for (const double delay_s : {0.0, 0.004}) {
      ControllerConfig config = cartesian_config();
      config.rate_hz = rate_hz;
      config.safety.device_delay_s = delay_s;
      guard_.configure(config);
      const int latest = 2 + static_cast<int>((0.005 + delay_s) * rate_hz);
      const int first = static_cast<int>(random() % static_cast<unsigned>(latest));
      const int last = latest - 1;
      const int period = 1 + static_cast<int>(random() % 50U);
      std::array<double, 64> held{};
      double command = 10.0;
      for (int tick = 0; tick < 20'000; ++tick) {
        command = random() % 12U == 0 ? -command : command;
        std::ranges::rotate(held, held.end() - 1);
        held.front() = command;
        drivers::JointSample sample;
        sample.effort_known = 0b001;
        if (tick % period == 0) {
          sample.effort_is_new = 0b001;
          sample.effort[0] = std::accumulate(held.begin() + first, held.begin() + last + 1, 0.0) /
                             (last - first + 1);
        }
        ASSERT_EQ(guard_.check(sample, pose_, {command, 0.0, 0.0}).faults, kNoFault)
            << tick << ", " << rate_hz << " Hz";
      }
    }
  }
}

TEST_F(EffortGuardTest, ADelayOfThreeTicksBehindStepsIsNoMismatch) {
  drivers::JointSample sample;
  sample.effort_known = 0b001;
  sample.effort_is_new = 0b001;
  std::array<double, 3> late{};
  for (int tick = 0; tick < 4000; ++tick) {
    const double commanded = tick % 80 < 40 ? 4.0 : -4.0;
    sample.effort[0] = late[0];
    EXPECT_EQ(guard_.check(sample, pose_, {commanded, 0.0, 0.0}).faults, kNoFault) << tick;
    late = {late[1], late[2], commanded};
  }
}

TEST_F(EffortGuardTest, AReversedMotorBehindASurfaceIsFoundBeforeFiveNewtons) {
  for (const double mass_kg : {0.1, 0.2, 0.3}) {
    guard_.rest();
    EXPECT_GT(pressed(-1.0, mass_kg), 0) << mass_kg;
    EXPECT_EQ(last_.faults, kFaultMotorReversed);
    EXPECT_EQ(last_.joint, 3U);
  }
}

TEST_F(EffortGuardTest, AMotorThatPushesOutOfTheSurfaceIsNot) {
  for (const double mass_kg : {0.1, 0.2, 0.4}) {
    guard_.rest();
    EXPECT_EQ(pressed(1.0, mass_kg), 0) << mass_kg;
  }
}

}  // namespace
}  // namespace tactus::firmware
