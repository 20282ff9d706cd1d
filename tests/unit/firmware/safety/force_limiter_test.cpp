#include "firmware/safety/force_limiter.h"

#include <gtest/gtest.h>

#include <random>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// 1 kHz, 5 N, no ramps and no slew unless a test sets them.
ControllerConfig open_config() {
  ControllerConfig config = cartesian_config();
  config.safety.max_force_N = 5.0;
  config.safety.force_slew_N_per_s = 1e6;
  config.safety.soft_start_s = 0.0;
  config.safety.contact_start_s = 0.0;
  return config;
}

// Runs both stages at once, as when no motion is slowed between them.
struct Limiter : ForceLimiter {
  LimitedForce limit(const Vec3& force_W, bool in_contact, const Vec3& effect_W = Vec3::Zero()) {
    const LimitedForce soft = soften(force_W, effect_W, in_contact);
    LimitedForce limited = ForceLimiter::limit(soft.force_W);
    limited.limits |= soft.limits;
    return limited;
  }
};

Limiter limiter_of(const ControllerConfig& config) {
  Limiter limiter;
  limiter.configure(config);
  return limiter;
}

TEST(ForceLimiter, TheFirstForceAfterActivationIsZero) {
  Limiter limiter = limiter_of(open_config());
  const LimitedForce first = limiter.limit({1.0, 2.0, 0.0}, true);
  EXPECT_EQ(first.force_W, Vec3::Zero());
  EXPECT_EQ(first.limits, kLimitSoftStart);
  const LimitedForce second = limiter.limit({1.0, 2.0, 0.0}, true);
  EXPECT_EQ(second.force_W, Vec3(1.0, 2.0, 0.0));
  EXPECT_EQ(second.limits, 0U);
}

TEST(ForceLimiter, PressedAtActivationTheForceFollowsBothRamps) {
  ControllerConfig config = open_config();
  config.safety.soft_start_s = 0.100;
  config.safety.contact_start_s = 0.020;
  Limiter limiter = limiter_of(config);
  for (int tick = 0; tick < 150; ++tick) {
    const double gain = std::min(1.0, tick / 100.0) * std::min(1.0, tick / 20.0);
    EXPECT_NEAR(limiter.limit({0.0, 4.0, 0.0}, true).force_W.y(), 4.0 * gain, 1e-12) << tick;
  }
}

TEST(ForceLimiter, OnlyTheFirstContactAfterActivationRamps) {
  ControllerConfig config = open_config();
  config.safety.contact_start_s = 0.010;
  Limiter limiter = limiter_of(config);
  for (int tick = 0; tick < 50; ++tick) {
    EXPECT_EQ(limiter.limit(Vec3::Zero(), false).limits, 0U);
  }
  for (int tick = 0; tick < 10; ++tick) {
    const LimitedForce limited = limiter.limit({2.0, 0.0, 0.0}, true);
    EXPECT_NEAR(limited.force_W.x(), 2.0 * tick / 10.0, 1e-12);
    EXPECT_EQ(limited.limits, kLimitSoftStart);
  }
  limiter.limit(Vec3::Zero(), false);
  EXPECT_NEAR(limiter.limit({2.0, 0.0, 0.0}, true).force_W.x(), 2.0, 1e-12);
  limiter.restart();
  EXPECT_EQ(limiter.limit({2.0, 0.0, 0.0}, true).force_W, Vec3::Zero());
}

// A field of 6 N without a surface: the gain of activation alone, whatever is touched and when.
TEST(ForceLimiter, EffectsRiseWithActivationAndAFirstTouchDoesNotReleaseThem) {
  ControllerConfig config = open_config();
  config.safety.max_force_N = 10.0;
  config.safety.soft_start_s = 0.100;
  config.safety.contact_start_s = 0.020;
  Limiter limiter = limiter_of(config);
  const Vec3 field(6.0, 0.0, 0.0);
  const Vec3 surface(0.0, 2.0, 0.0);
  for (int tick = 0; tick < 300; ++tick) {
    const bool touches = tick >= 50;
    const Vec3 force = touches ? Vec3{field + surface} : field;
    const Vec3 limited = limiter.limit(force, touches, field).force_W;
    const double activation = std::min(1.0, tick / 100.0);
    const double contact = touches ? std::min(1.0, (tick - 50) / 20.0) : 0.0;
    EXPECT_NEAR(limited.x(), 6.0 * activation, 1e-12) << tick;
    EXPECT_NEAR(limited.y(), 2.0 * activation * contact, 1e-12) << tick;
  }
}

TEST(ForceLimiter, ALargestForceThatIsRaisedComesInWithinTheSoftStart) {
  ControllerConfig config = open_config();
  config.safety.max_force_N = 2.0;
  config.safety.soft_start_s = 0.100;
  Limiter limiter = limiter_of(config);
  for (int tick = 0; tick < 200; ++tick) {
    limiter.limit({9.0, 0.0, 0.0}, true);
  }
  config.safety.max_force_N = 8.0;
  limiter.retune(config);
  for (int tick = 1; tick <= 100; ++tick) {
    EXPECT_NEAR(limiter.limit({9.0, 0.0, 0.0}, true).force_W.x(), std::min(8.0, 2.0 + 0.08 * tick),
                1e-12);
  }
  config.safety.max_force_N = 1.0;
  limiter.retune(config);
  EXPECT_NEAR(limiter.limit({9.0, 0.0, 0.0}, true).force_W.x(), 1.0, 1e-12);
}

TEST(ForceLimiter, TheClampKeepsTheDirection) {
  Limiter limiter = limiter_of(open_config());
  limiter.limit({1.0, 0.0, 0.0}, true);
  const LimitedForce limited = limiter.limit({30.0, 0.0, -40.0}, true);
  EXPECT_LT((limited.force_W - Vec3(3.0, 0.0, -4.0)).norm(), 1e-14);
  EXPECT_EQ(limited.limits, kLimitForce);
}

TEST(ForceLimiter, TheClampHoldsForForcesThatWouldOverflow) {
  Limiter limiter = limiter_of(open_config());
  limiter.limit({1.0, 0.0, 0.0}, true);
  const LimitedForce limited = limiter.limit({3e307, 0.0, 4e307}, true);
  EXPECT_LT((limited.force_W - Vec3(3.0, 0.0, 4.0)).norm(), 1e-14);
}

TEST(ForceLimiter, TheSlewStepsStraightTowardTheForce) {
  ControllerConfig config = open_config();
  config.safety.force_slew_N_per_s = 1000.0;
  Limiter limiter = limiter_of(config);
  limiter.limit({3.0, 0.0, 0.0}, true);
  EXPECT_EQ(limiter.limit({3.0, 0.0, 0.0}, true).force_W, Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(limiter.limit({3.0, 0.0, 0.0}, true).limits, kLimitSlew);
  EXPECT_EQ(limiter.limit({3.0, 0.0, 0.0}, true).limits, 0U);
  EXPECT_EQ(limiter.limit({0.0, 4.0, 0.0}, true).force_W, Vec3(3.0 - 0.6, 0.8, 0.0));
}

TEST(ForceLimiter, TheSlewStartsFromTheForceThatWentOut) {
  ControllerConfig config = open_config();
  config.safety.force_slew_N_per_s = 1000.0;
  Limiter limiter = limiter_of(config);
  limiter.limit({5.0, 0.0, 0.0}, true);
  limiter.limit({5.0, 0.0, 0.0}, true);
  limiter.applied({0.25, 0.0, 0.0});
  EXPECT_EQ(limiter.limit({5.0, 0.0, 0.0}, true).force_W, Vec3(1.25, 0.0, 0.0));
}

TEST(ForceLimiter, ARestartForgetsTheForceTheRampsAndTheTouchBeforeIt) {
  ControllerConfig config = open_config();
  config.safety.force_slew_N_per_s = 1000.0;
  config.safety.soft_start_s = 0.100;
  config.safety.contact_start_s = 0.010;
  Limiter limiter = limiter_of(config);
  for (int tick = 0; tick < 200; ++tick) {
    limiter.limit({3.0, 0.0, 0.0}, true);
  }
  limiter.restart();
  const Vec3 field(0.0, 2.0, 0.0);
  for (int tick = 0; tick < 50; ++tick) {
    const Vec3 limited = limiter.limit(field, false, field).force_W;
    EXPECT_EQ(limited.x(), 0.0) << tick;
    EXPECT_NEAR(limited.y(), 2.0 * tick / 100.0, 1e-12) << tick;
  }
  EXPECT_EQ(limiter.limit({3.0, 2.0, 0.0}, true, field).force_W.x(), 0.0);
}

TEST(ForceLimiter, RandomForcesNeverExceedClampOrSlew) {
  constexpr std::uint64_t kSeed = 20261121;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  std::mt19937_64 generator(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 200; ++run) {
    ControllerConfig config = open_config();
    config.safety.max_force_N = 25.0 * (1.0 + unit(generator));
    config.safety.force_slew_N_per_s = std::pow(10.0, 3.0 + 2.5 * unit(generator));
    config.safety.soft_start_s = 0.05 * (1.0 + unit(generator));
    Limiter limiter = limiter_of(config);
    const double step = config.safety.force_slew_N_per_s / config.rate_hz;
    Vec3 last = Vec3::Zero();
    for (int tick = 0; tick < 500; ++tick) {
      const double size = std::pow(10.0, 4.0 * unit(generator));
      const Vec3 force = size * Vec3(unit(generator), unit(generator), unit(generator));
      const Vec3 limited = limiter.limit(force, unit(generator) > -0.5).force_W;
      ASSERT_LE(limited.norm(), config.safety.max_force_N * (1.0 + 1e-12));
      ASSERT_LE((limited - last).norm(), step * (1.0 + 1e-12) + 1e-14);
      last = limited;
    }
  }
}

TEST(EffortScale, KeepsTheRatiosAndMeetsTheTightestLimit) {
  const std::array<JointLimits, kJointCount> limits = {
      {{.max_effort = 1.0}, {.max_effort = 2.0}, {.max_effort = 3.0}}};
  EXPECT_EQ(effort_scale({0.9, -2.0, 3.0}, limits), 1.0);
  EXPECT_DOUBLE_EQ(effort_scale({2.0, -2.0, 3.0}, limits), 0.5);
  EXPECT_DOUBLE_EQ(effort_scale({2.0, -10.0, 3.0}, limits), 0.2);
  EXPECT_DOUBLE_EQ(effort_scale({0.0, 0.0, -300.0}, limits), 0.01);
}

TEST(EffortScale, LeavesRoomForWhatTheJointsAlreadyGive) {
  const std::array<JointLimits, kJointCount> limits = {
      {{.max_effort = 1.0}, {.max_effort = 2.0}, {.max_effort = 3.0}}};
  EXPECT_DOUBLE_EQ(effort_scale({2.0, 0.0, 0.0}, limits, {0.6, 2.0, -3.0}), 0.2);
  EXPECT_DOUBLE_EQ(effort_scale({-2.0, 0.0, 0.0}, limits, {0.6, 2.0, -3.0}), 0.8);
  EXPECT_DOUBLE_EQ(effort_scale({0.0, 0.0, 12.0}, limits, {0.0, 0.0, -3.0}), 0.5);
  EXPECT_EQ(effort_scale({0.0, 1.0, 0.0}, limits, {0.0, 2.0, 0.0}), 0.0);
}

TEST(LengthOf, DoesNotOverflow) {
  EXPECT_EQ(length_of(Vec3::Zero()), 0.0);
  EXPECT_DOUBLE_EQ(length_of({3.0, 0.0, 4.0}), 5.0);
  EXPECT_DOUBLE_EQ(length_of({3e307, 0.0, -4e307}), 5e307);
}

}  // namespace
}  // namespace tactus::firmware
