// Homing by hard stop against a joint with mass, stops and things in its way: the true position is
// the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

#include "drivers/composition/homing.h"

namespace tactus::drivers {
namespace {

// The joint of the audit: stop at -1, range to 1, nothing that damps it.
struct StopPlant {
  double position = 0.7;
  double speed = 0.0;
  double mass = 0.001;
  double friction = 0.0;    // N m: dry
  double damping = 0.0;     // N m s/rad
  double motor_sign = 1.0;  // -1: wired the wrong way
  double scale = 1.0;       // of the encoder
  double lowest = -1.0;
  double highest = 1.05;
  bool is_dead = false;  // the motor is unplugged

  void step(double effort) {
    double force = (is_dead ? 0.0 : motor_sign * effort) - damping * speed;
    const double held = friction;
    if (speed == 0.0) {
      force = std::abs(force) <= held ? 0.0 : force - std::copysign(held, force);
    } else {
      const double drag = std::min(held, std::abs(speed) * mass / 1e-3 + std::abs(force));
      force -= std::copysign(drag, speed);
    }
    speed += force / mass * 1e-3;
    position += speed * 1e-3;
    if (position < lowest || position > highest) {
      position = std::clamp(position, lowest, highest);
      speed = 0.0;
    }
  }
};

struct StopRun {
  explicit StopRun(const Reference& reference = low_stop(), const Transmission& gears = {})
      : homing(reference, gears) {}
  static Reference low_stop() {
    return {.kind = ReferenceKind::hard_stop,
            .position = -1.0,
            .search_effort = -0.2,
            .search_speed = 0.5,
            .lower = -1.0,
            .upper = 1.0};
  }

  AxisSample sample(double encoder_direction = 1.0) const {
    return {.position_rad = encoder_direction * plant.scale * plant.position + 3.0,
            .velocity_rad_per_s = encoder_direction * plant.scale * plant.speed,
            .status = kDeviceOk};
  }
  // Runs until the joint is referenced or has failed, at most 80 s.
  void run(double encoder_direction = 1.0) {
    for (ms = 0; ms < 80'000 && !homing.is_referenced() && !homing.trouble(); ++ms) {
      each_ms(ms);
      homing.advance(sample(encoder_direction), true, ms * hal::TimeNs{1'000'000});
      most_effort = std::max(most_effort, std::abs(homing.effort()));
      most_rise = std::max(most_rise, std::abs(homing.effort()) - last_effort);
      last_effort = std::abs(homing.effort());
      plant.step(homing.effort());
      most_speed = std::max(most_speed, std::abs(plant.speed));
    }
  }
  double said() const { return joint_position(homing.transmission(), sample().position_rad); }

  StopPlant plant;
  Homing homing;
  std::function<void(int)> each_ms = [](int) {};
  int ms = 0;
  double most_effort = 0.0;
  double most_rise = 0.0;
  double last_effort = 0.0;
  double most_speed = 0.0;
};

void expect_refused(const StopRun& run, std::string_view what) {
  EXPECT_FALSE(run.homing.is_referenced());
  EXPECT_EQ(run.homing.trouble().what, what);
  EXPECT_FALSE(run.homing.trouble().remedy.empty());
  EXPECT_EQ(run.homing.effort(), 0.0);
}

TEST(HardStop, IsFoundFromAnywhereAndOnEitherSide) {
  for (const double way : {-1.0, 1.0}) {
    for (const double start : {-1.0, -0.99, 0.0, 0.7, 1.0}) {
      SCOPED_TRACE(start);
      Reference reference = StopRun::low_stop();
      reference.position = way;
      reference.search_effort = 0.2 * way;
      StopRun run(reference);
      run.plant.lowest = way < 0.0 ? -1.0 : -1.05;
      run.plant.highest = way < 0.0 ? 1.05 : 1.0;
      run.plant.position = start;
      run.run();
      ASSERT_TRUE(run.homing.is_referenced()) << run.homing.trouble().what;
      EXPECT_NEAR(run.said(), run.plant.position, 1e-9);
      EXPECT_LE(run.most_effort, 0.2);
      EXPECT_EQ(run.homing.effort(), 0.0);
    }
  }
}

TEST(HardStop, IsFoundThroughGearsAndFriction) {
  for (const double friction : {0.02, 0.1, 0.15}) {
    SCOPED_TRACE(friction);
    StopRun run(StopRun::low_stop(), {.motor_ratio = 10.0, .encoder_ratio = 10.0});
    run.plant.scale = 10.0;
    run.plant.mass = 0.02;
    run.plant.friction = friction;
    run.run();
    ASSERT_TRUE(run.homing.is_referenced()) << run.homing.trouble().what;
    EXPECT_NEAR(run.said(), run.plant.position, 1e-9);
  }
}

// Nothing but the search itself slows this joint down.
TEST(HardStop, SearchIsDampedToItsSpeedAndRisesSlowly) {
  for (const double mass : {0.001, 0.01, 0.1}) {
    SCOPED_TRACE(mass);
    StopRun run;
    run.plant.mass = mass;
    run.run();
    ASSERT_TRUE(run.homing.is_referenced()) << run.homing.trouble().what;
    EXPECT_LE(run.most_speed, 1.1 * 0.5);
    EXPECT_GE(run.most_speed, 0.8 * 0.5);
    EXPECT_LE(run.most_rise, 0.2 * 0.02);
  }
}

TEST(HardStop, ShaftThatNeverMovesIsNoStop) {
  StopRun dead;
  dead.plant.is_dead = true;
  dead.run();
  expect_refused(dead, "homing: the joint did not move under search_effort");
  StopRun held;
  held.plant.friction = 0.3;
  held.run();
  expect_refused(held, "homing: the joint did not move under search_effort");
}

TEST(HardStop, ObstacleHalfWayIsNoStop) {
  StopRun run;
  run.plant.lowest = 0.2;
  run.run();
  expect_refused(run, "homing: the joint moves less than its range");
}

TEST(HardStop, ObstacleThatTakesMoreThanTwoHundredthsOfTheRangeIsNoStop) {
  StopRun run;
  run.plant.lowest = -0.9;
  run.plant.highest = 1.0;
  run.run();
  expect_refused(run, "homing: the joint moves less than its range");
}

TEST(HardStop, HandThatGoesAwayOrComesBetweenTheApproachesIsNoStop) {
  StopRun leaves;
  leaves.plant.lowest = 0.2;
  bool met = false;
  leaves.each_ms = [&leaves, &met](int) {
    met = met || leaves.plant.position < 0.201;
    if (met && leaves.plant.position > 0.25) {
      leaves.plant.lowest = -1.0;
    }
  };
  leaves.run();
  expect_refused(leaves, "homing: the joint stopped in two places, so an obstacle stopped it");
  StopRun comes;
  bool touched = false;
  comes.each_ms = [&comes, &touched](int) {
    touched = touched || comes.plant.position < -0.999;
    if (touched && comes.plant.position > -0.93) {
      comes.plant.lowest = std::max(comes.plant.lowest, -0.95);
    }
  };
  comes.run();
  expect_refused(comes, "homing: the joint stopped in two places, so an obstacle stopped it");
}

TEST(HardStop, WrongSignOfMotorOrEncoderIsFoundWithinAHundredthOfARadian) {
  for (const bool motor : {true, false}) {
    SCOPED_TRACE(motor);
    StopRun run;
    run.plant.motor_sign = motor ? -1.0 : 1.0;
    run.plant.position = 0.0;
    run.run(motor ? 1.0 : -1.0);
    expect_refused(run, "homing: the joint moves against the push");
    EXPECT_LE(std::abs(run.plant.position), 0.012);
    EXPECT_LE(run.most_speed, 0.5);
  }
}

TEST(HardStop, JointThatJumpsOrRunsAwayOrIsNoNumberFailsAtOnce) {
  StopRun jumps;
  jumps.each_ms = [&jumps](int ms) { jumps.plant.position += ms == 1000 ? 0.1 : 0.0; };
  jumps.run();
  expect_refused(jumps, "homing: the joint jumped or moved faster than 3 times search_speed");
  EXPECT_EQ(jumps.ms, 1001);
  StopRun pulled;
  pulled.each_ms = [&pulled](int ms) {
    pulled.plant.speed = ms > 1000 ? -2.0 : pulled.plant.speed;
  };
  pulled.run();
  expect_refused(pulled, "homing: the joint jumped or moved faster than 3 times search_speed");
  EXPECT_LE(pulled.ms, 1060);
  StopRun nothing;
  nothing.each_ms = [&nothing](int ms) {
    nothing.plant.position =
        ms == 1000 ? std::numeric_limits<double>::quiet_NaN() : nothing.plant.position;
  };
  nothing.run();
  expect_refused(nothing, "homing: the position or the velocity is not a number");
}

TEST(HardStop, EncoderThatSaysAQuarterOfTheTravelOrEndlessTravelIsRefused) {
  StopRun quarter;
  quarter.plant.scale = 0.25;
  quarter.plant.position = 0.9;
  quarter.run();
  expect_refused(quarter, "homing: the joint moves less than its range");
  StopRun endless;
  endless.plant.lowest = -100.0;
  endless.run();
  expect_refused(endless, "homing: the joint moved twice its range without a stop");
}

TEST(HardStop, RangeThatIsNotKnownNeedsADeclaredTravel) {
  Reference reference{.kind = ReferenceKind::hard_stop, .position = -1.0, .search_effort = -0.2};
  StopRun unknown(reference);
  unknown.run();
  expect_refused(unknown, "homing by hard stop needs the joint's range");
  reference.min_travel = 0.5;
  StopRun declared(reference);
  declared.run();
  ASSERT_TRUE(declared.homing.is_referenced()) << declared.homing.trouble().what;
  EXPECT_NEAR(declared.said(), declared.plant.position, 1e-9);
}

TEST(HardStop, StaleSamplesAreNoStanding) {
  StopRun run;
  for (int ms = 0; ms < 3000; ++ms) {
    AxisSample sample = run.sample();
    sample.status = ms > 0 ? kDeviceStale : kDeviceOk;
    run.homing.advance(sample, true, ms * hal::TimeNs{1'000'000});
    ASSERT_FALSE(run.homing.is_referenced());
    ASSERT_FALSE(run.homing.trouble());
  }
}

}  // namespace
}  // namespace tactus::drivers
