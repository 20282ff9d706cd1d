#include "drivers/composition/transmission.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

namespace tactus::drivers {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Published: a count of the Falcon is 0.0364347 degrees of its arm, whose angle is 35 degrees at
// count 0.
TEST(Transmission, TheFalconsCapstanGivesThePublishedArmAngles) {
  const double ratio = 0.110 / 0.01425;
  const Transmission arm{.motor_ratio = ratio, .encoder_ratio = ratio, .offset = 35.0 * kDegree};
  const auto angle_deg = [&](std::int64_t counts) {
    return joint_position(arm, shaft_rad(counts, 1280.0)) / kDegree;
  };
  EXPECT_NEAR(angle_deg(0), 35.0, 1e-12);
  EXPECT_NEAR(angle_deg(1000), 71.434659, 1e-6);
  EXPECT_NEAR(angle_deg(-1000), -1.434659, 1e-6);
  EXPECT_NEAR(angle_deg(-500), 16.78267, 1e-5);
}

// Published: encoders (800, 500, 6000) of WoodenHaptics are 9, 7.5 and 90 degrees.
TEST(Transmission, TheWoodenHapticsCapstansGiveThePublishedAngles) {
  const Transmission a{.motor_ratio = 16.0, .encoder_ratio = 16.0};
  const Transmission b{.motor_ratio = 12.0, .encoder_ratio = 12.0};
  EXPECT_NEAR(joint_position(a, shaft_rad(800, 2000.0)) / kDegree, 9.0, 1e-12);
  EXPECT_NEAR(joint_position(b, shaft_rad(500, 2000.0)) / kDegree, 7.5, 1e-12);
  EXPECT_NEAR(joint_position(b, shaft_rad(6000, 2000.0)) / kDegree, 90.0, 1e-12);
}

// Published: one newton at the Hapkit's handle takes 0.00376171 N m of its motor, and the motor's
// 0.03 N m are 7.975 N.
TEST(Transmission, TheHapkitsSectorGivesThePublishedTorque) {
  const double handle_m = 0.065659;
  const Transmission sector{.motor_ratio = 0.073152 / 0.004191};
  EXPECT_NEAR(motor_torque_Nm(sector, 1.0 * handle_m), 0.00376171, 5e-9);
  EXPECT_NEAR(joint_effort(sector, 0.03) / handle_m, 7.975, 5e-4);
}

TEST(Transmission, ALinearAxisOnADrumPullsWithTorqueByRadius) {
  constexpr double kDrum_m = 0.008;
  const Transmission axis{.motor_ratio = 1.0 / kDrum_m, .encoder_ratio = 1.0 / kDrum_m};
  EXPECT_NEAR(joint_effort(axis, 0.04), 5.0, 1e-12);
  EXPECT_NEAR(joint_position(axis, 2.0 * std::numbers::pi), 2.0 * std::numbers::pi * kDrum_m,
              1e-15);
}

TEST(Transmission, EveryWayThereHasItsWayBack) {
  constexpr std::uint64_t kSeed = 20261122;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 10'000; ++i) {
    const Transmission t{.motor_ratio = std::pow(10.0, 3.0 * unit(random)),
                         .encoder_ratio = std::pow(10.0, 3.0 * unit(random)),
                         .motor_direction = unit(random) > 0.0 ? 1.0 : -1.0,
                         .encoder_direction = unit(random) > 0.0 ? 1.0 : -1.0,
                         .offset = 3.0 * unit(random)};
    ASSERT_TRUE(is_valid(t));
    const double joint = 3.0 * unit(random);
    ASSERT_NEAR(joint_position(t, encoder_position_rad(t, joint)), joint, 1e-14);
    ASSERT_NEAR(motor_torque_Nm(t, joint_effort(t, joint)), joint, 1e-14);
    const auto counts = static_cast<std::int64_t>(1e9 * unit(random));
    ASSERT_EQ(shaft_counts(shaft_rad(counts, 4096.0), 4096.0), counts);

    // Power in is power out where motor and encoder share a shaft.
    Transmission shared = t;
    shared.encoder_ratio = t.motor_ratio;
    shared.encoder_direction = t.motor_direction;
    const double speed = unit(random);
    ASSERT_NEAR(joint_effort(shared, 0.1) * joint_velocity(shared, speed), 0.1 * speed, 1e-15);

    Transmission homed = t;
    homed.offset = offset_at(t, joint, 0.25);
    ASSERT_NEAR(joint_position(homed, joint), 0.25, 1e-12 / t.encoder_ratio + 1e-15);
  }
}

TEST(Transmission, WhatCannotBeATransmissionIsRefused) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, kInfinity, kNaN}) {
    EXPECT_FALSE(is_valid({.motor_ratio = bad})) << bad;
    EXPECT_FALSE(is_valid({.encoder_ratio = bad})) << bad;
  }
  for (const double bad : {0.0, 0.5, 2.0, kInfinity, kNaN}) {
    EXPECT_FALSE(is_valid({.motor_direction = bad})) << bad;
    EXPECT_FALSE(is_valid({.encoder_direction = bad})) << bad;
  }
  EXPECT_FALSE(is_valid({.offset = kNaN}));
  EXPECT_TRUE(is_valid({.motor_direction = -1.0, .offset = -2.0}));
}

}  // namespace
}  // namespace tactus::drivers
