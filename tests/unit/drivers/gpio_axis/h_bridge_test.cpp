#include "drivers/gpio_axis/h_bridge.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

constexpr BridgeConfig kBridge{
    .full_duty_torque_Nm = 0.05, .max_torque_Nm = 0.04, .pwm_period_ns = 100'000};

BridgeConfig with(BridgeMode mode, TorqueLaw law = TorqueLaw::linear) {
  BridgeConfig config = kBridge;
  config.mode = mode;
  config.law = law;
  return config;
}

// The torque that a duty and direction stand for, from the law's definition.
double torque_of(const BridgeConfig& config, const BridgeOutput& output) {
  const double high =
      static_cast<double>(output.duty_ns) / static_cast<double>(config.pwm_period_ns);
  double part = output.reverse ? -high : high;
  if (config.mode == BridgeMode::locked_antiphase) {
    part = 2.0 * high - 1.0;
  }
  if (config.law == TorqueLaw::square_root) {
    part *= std::abs(part);
  }
  return (config.reversed ? -part : part) * config.full_duty_torque_Nm;
}

TEST(HBridge, TorqueComesBackFromTheDutyInEveryModeAndLaw) {
  for (const auto mode : {BridgeMode::sign_magnitude, BridgeMode::locked_antiphase}) {
    for (const auto law : {TorqueLaw::linear, TorqueLaw::square_root}) {
      for (const bool reversed : {false, true}) {
        BridgeConfig config = with(mode, law);
        config.reversed = reversed;
        HBridge bridge(config);
        for (double torque_Nm = -0.04; torque_Nm <= 0.04; torque_Nm += 0.001) {
          EXPECT_NEAR(torque_of(config, bridge.drive(torque_Nm, 1'000'000'000)), torque_Nm, 2e-6);
        }
      }
    }
  }
}

// The fact sheet's check points of the Hapkit: pulley 4.191 mm, sector 73.152 mm, handle 65.659 mm,
// 0.03 N m at full duty.
TEST(HBridge, HapkitsDutiesAreThoseOfTheFactSheet) {
  constexpr double kTorquePerNewton = 0.065659 * 0.004191 / 0.073152;
  EXPECT_NEAR(kTorquePerNewton, 0.00376171, 1e-8);
  EXPECT_NEAR(duty_of(TorqueLaw::square_root, 1.0 * kTorquePerNewton / 0.03), 0.354105, 1e-6);
  EXPECT_NEAR(duty_of(TorqueLaw::square_root, 2.0 * kTorquePerNewton / 0.03), 0.500780, 1e-6);
  EXPECT_NEAR(duty_of(TorqueLaw::square_root, 5.0 * kTorquePerNewton / 0.03), 0.791803, 1e-6);
}

TEST(HBridge, NeverMoreThanTheMaximumWhateverIsAskedFor) {
  hal::Random random(11);
  for (const auto mode : {BridgeMode::sign_magnitude, BridgeMode::locked_antiphase}) {
    for (const auto law : {TorqueLaw::linear, TorqueLaw::square_root}) {
      const BridgeConfig config = with(mode, law);
      HBridge bridge(config);
      hal::TimeNs now_ns = 1'000'000'000;
      for (int i = 0; i < 20'000; ++i) {
        const std::uint64_t bits = std::uint64_t{random.bits()} << 32U | random.bits();
        const auto wanted_Nm = std::bit_cast<double>(bits);
        now_ns += 1'000'000;
        const BridgeOutput output = bridge.drive(wanted_Nm, now_ns);
        ASSERT_GE(output.duty_ns, 0);
        ASSERT_LE(output.duty_ns, config.pwm_period_ns);
        ASSERT_LE(std::abs(torque_of(config, output)), config.max_torque_Nm + 1e-12) << wanted_Nm;
      }
    }
  }
}

TEST(HBridge, WhatIsNotANumberIsNoTorque) {
  HBridge bridge(kBridge);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(bridge.drive(bad, 0).duty_ns, 0);
  }
}

TEST(HBridge, MaximumDutyBoundsWhatTheLawWouldGive) {
  BridgeConfig config = kBridge;
  config.max_duty = 0.5;
  HBridge bridge(config);
  EXPECT_EQ(bridge.drive(0.04, 0).duty_ns, 50'000);
}

TEST(HBridge, DirectionChangesOnlyAfterTheDeadTimeAtZero) {
  BridgeConfig config = kBridge;
  config.direction_dead_us = 1500;
  HBridge bridge(config);
  hal::TimeNs now_ns = 1'000'000'000;
  EXPECT_GT(bridge.drive(0.01, now_ns).duty_ns, 0);
  for (const hal::TimeNs after_ns : {1'000'000, 2'000'000}) {
    const BridgeOutput output = bridge.drive(-0.01, now_ns + after_ns);
    EXPECT_EQ(output.duty_ns, 0);
    EXPECT_FALSE(output.reverse);
  }
  const BridgeOutput turned = bridge.drive(-0.01, now_ns + 2'500'000);
  EXPECT_GT(turned.duty_ns, 0);
  EXPECT_TRUE(turned.reverse);
}

TEST(HBridge, TimeAtZeroCountsAsDeadTime) {
  BridgeConfig config = kBridge;
  config.direction_dead_us = 1500;
  HBridge bridge(config);
  EXPECT_GT(bridge.drive(0.01, 1'000'000'000).duty_ns, 0);
  EXPECT_EQ(bridge.drive(0.0, 1'001'000'000).duty_ns, 0);
  EXPECT_GT(bridge.drive(-0.01, 1'003'000'000).duty_ns, 0);
}

TEST(HBridge, LockedAntiphaseRestsAtHalf) {
  HBridge bridge(with(BridgeMode::locked_antiphase));
  EXPECT_EQ(bridge.idle(0).duty_ns, 50'000);
}

}  // namespace
}  // namespace tactus::drivers
