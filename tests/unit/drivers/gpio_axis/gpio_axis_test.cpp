#include "drivers/gpio_axis/gpio_axis.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/drivers/gpio_axis/axis_bench.h"

namespace tactus::drivers {
namespace {

constexpr double kDutyStep_Nm = 0.05 / 40'000.0;

AxisCommand torque(double torque_Nm) {
  return {.torque_Nm = torque_Nm, .enable = true};
}

TEST(GpioAxis, StartsSafeAndReady) {
  AxisBench bench;
  bench.axis.read(std::span(&bench.sample, 1), hal::kNoWait);
  EXPECT_EQ(bench.sample.status, kDeviceOk);
  EXPECT_EQ(bench.sample.position_rad, 0.0);
  EXPECT_FALSE(bench.axis.trouble(0));
  EXPECT_FALSE(bench.is_enabled());
  EXPECT_TRUE(bench.emulator.brake_is_closed());
  EXPECT_EQ(bench.pwm.settings().duty_ns, 0);
}

TEST(GpioAxis, FollowsTheShaftWithinACount) {
  AxisBench bench;
  const double start_s = 1e-9 * static_cast<double>(bench.clock.now_ns());
  const auto motion = [&](double time_s) { return 0.6 * std::sin(20.0 * (time_s - start_s)); };
  for (int i = 0; i < 500; ++i) {
    bench.tick(kIdleOn, motion);
    ASSERT_EQ(bench.sample.status, kDeviceOk);
    ASSERT_NEAR(bench.sample.position_rad, bench.emulator.shaft().position_rad, kCount_rad);
    ASSERT_EQ(bench.sample.time_ns, bench.clock.now_ns());
  }
}

TEST(GpioAxis, VelocityFollowsTheShaft) {
  AxisBench bench;
  const double start_s = 1e-9 * static_cast<double>(bench.clock.now_ns());
  const auto motion = [&](double time_s) { return 6.0 * (time_s - start_s); };
  bench.ticks(50, kIdleOn, motion);
  for (int i = 0; i < 100; ++i) {
    bench.tick(kIdleOn, motion);
    ASSERT_NEAR(bench.sample.velocity_rad_per_s, 6.0, 0.2);
  }
}

TEST(GpioAxis, ReversedEncoderCountsTheOtherWay) {
  GpioAxisConfig config = full_config();
  config.encoder.reversed = true;
  AxisBench bench(config);
  for (int count = 1; count <= 10; ++count) {
    bench.emulator.shaft().position_rad = count * kCount_rad;
    bench.tick(kIdleOn);
  }
  EXPECT_NEAR(bench.sample.position_rad, 10.0 * kCount_rad, 1e-12);
}

TEST(GpioAxis, CommandedTorqueReachesTheMotor) {
  for (const auto mode : {BridgeMode::sign_magnitude, BridgeMode::locked_antiphase}) {
    for (const auto law : {TorqueLaw::linear, TorqueLaw::square_root}) {
      GpioAxisConfig config = full_config();
      config.bridge.mode = mode;
      config.bridge.law = law;
      AxisBench bench(config);
      for (const double wanted_Nm : {0.01, 0.04, -0.003, -0.04, 0.0}) {
        bench.ticks(2, torque(wanted_Nm));
        EXPECT_NEAR(bench.torque(), wanted_Nm, 3.0 * kDutyStep_Nm);
      }
    }
  }
}

TEST(GpioAxis, NeverMoreThanTheMaximum) {
  AxisBench bench;
  for (const double wanted_Nm : {1.0, -1e300, std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()}) {
    bench.ticks(3, torque(wanted_Nm));
    EXPECT_LE(std::abs(bench.torque()), 0.04 + 1e-12);
  }
}

TEST(GpioAxis, DisabledMeansNoPowerAndAClosedBrake) {
  AxisBench bench;
  bench.ticks(3, torque(0.02));
  EXPECT_TRUE(bench.is_enabled());
  EXPECT_FALSE(bench.emulator.brake_is_closed());
  bench.tick({.torque_Nm = 0.02, .enable = false});
  EXPECT_FALSE(bench.is_enabled());
  EXPECT_TRUE(bench.emulator.brake_is_closed());
  EXPECT_EQ(bench.torque(), 0.0);
  EXPECT_EQ(bench.pwm.settings().duty_ns, 0);
}

TEST(GpioAxis, TorqueRampsUpAfterPowerUp) {
  GpioAxisConfig config = full_config();
  config.torque_ramp_ms = 10;
  AxisBench bench(config);
  double last_Nm = -1.0;
  for (int i = 0; i < 10; ++i) {
    bench.tick(torque(0.04));
    EXPECT_LE(bench.torque(), 0.04 * i / 10.0 + 1e-9);
    EXPECT_GE(bench.torque(), last_Nm);
    last_Nm = bench.torque();
  }
  bench.tick(torque(0.04));
  EXPECT_NEAR(bench.torque(), 0.04, 3.0 * kDutyStep_Nm);
}

TEST(GpioAxis, LimitSwitchBlocksOnlyTheWayFurther) {
  AxisBench bench;
  bench.emulator.open_limit_high(true);
  bench.ticks(10, torque(0.02));
  EXPECT_EQ(bench.torque(), 0.0);
  bench.ticks(2, torque(-0.02));
  EXPECT_NEAR(bench.torque(), -0.02, 3.0 * kDutyStep_Nm);
  bench.emulator.open_limit_high(false);
  bench.emulator.open_limit_low(true);
  bench.ticks(10, torque(-0.02));
  EXPECT_EQ(bench.torque(), 0.0);
  EXPECT_EQ(bench.sample.status, kDeviceOk);
}

TEST(GpioAxis, ABouncingLimitSwitchIsWaitedOut) {
  AxisBench bench;
  for (int i = 0; i < 20; ++i) {
    bench.emulator.open_limit_high(i % 2 == 0);
    bench.tick(torque(0.02));
    ASSERT_GT(bench.torque(), 0.0);
  }
}

TEST(GpioAxis, HeartbeatTogglesWithEveryWriteAndStopsWithThePower) {
  AxisBench bench;
  bool last = bench.chip.level(11);
  for (int i = 0; i < 10; ++i) {
    bench.tick(torque(0.01));
    EXPECT_NE(bench.chip.level(11), last);
    last = bench.chip.level(11);
  }
  bench.ticks(2, {});
  last = bench.chip.level(11);
  bench.ticks(5, {});
  EXPECT_EQ(bench.chip.level(11), last);
}

TEST(GpioAxis, AHungProgramLosesTheMotorByTheHeartbeat) {
  AxisBench bench;
  bench.ticks(10, torque(0.02));
  EXPECT_GT(bench.torque(), 0.0);
  for (int i = 0; i < 11; ++i) {
    bench.run_plant();
  }
  EXPECT_EQ(bench.torque(), 0.0);
}

TEST(GpioAxis, ReadsWithoutWritesCutThePower) {
  AxisBench bench;
  bench.ticks(10, torque(0.02));
  for (int i = 0; i < 21; ++i) {
    bench.run_plant();
    bench.axis.read(std::span(&bench.sample, 1), hal::kNoWait);
  }
  EXPECT_FALSE(bench.is_enabled());
  EXPECT_EQ(bench.pwm.settings().duty_ns, 0);
  bench.ticks(2, torque(0.02));
  EXPECT_GT(bench.torque(), 0.0);
}

TEST(GpioAxis, IndexIsReportedWhereItIs) {
  AxisBench bench;
  EXPECT_FALSE(bench.sample.index_seen);
  const double start_s = 1e-9 * static_cast<double>(bench.clock.now_ns());
  const auto forward = [&](double time_s) { return 10.0 * (time_s - start_s); };
  bench.ticks(700, kIdleOn, forward);
  ASSERT_EQ(bench.sample.status, kDeviceOk) << bench.axis.trouble(0).what;
  ASSERT_TRUE(bench.sample.index_seen);
  EXPECT_NEAR(bench.sample.index_rad, 2.0 * std::numbers::pi + 2.0 * kCount_rad, 1e-9);
  EXPECT_EQ(bench.axis.index_error(), 0);
}

TEST(GpioAxis, StopTakesThePowerAndStartBringsItBack) {
  AxisBench bench;
  bench.ticks(3, torque(0.02));
  bench.axis.stop();
  EXPECT_FALSE(bench.is_enabled());
  EXPECT_EQ(bench.pwm.settings().duty_ns, 0);
  bench.ticks(2, torque(0.02));
  EXPECT_EQ(bench.torque(), 0.0);
  EXPECT_EQ(bench.sample.status, kDeviceNotReady);
  bench.axis.start();
  bench.ticks(3, torque(0.02));
  EXPECT_EQ(bench.sample.status, kDeviceOk);
  EXPECT_GT(bench.torque(), 0.0);
}

TEST(GpioAxis, DirectionLineChangesOnlyAtZeroDuty) {
  GpioAxisConfig config = full_config();
  config.bridge.direction_dead_us = 2000;
  AxisBench bench(config);
  for (int i = 0; i < 200; ++i) {
    const bool before = bench.chip.level(8);
    const bool idle_before = bench.pwm.settings().duty_ns == 0;
    bench.tick(torque(i / 5 % 2 == 0 ? 0.02 : -0.02));
    if (bench.chip.level(8) != before) {
      EXPECT_TRUE(idle_before);
    }
  }
}

}  // namespace
}  // namespace tactus::drivers
