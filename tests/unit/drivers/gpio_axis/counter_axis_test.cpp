// The axis over a hardware counter instead of GPIO edges.
#include <numbers>

#include "hal/simulated/counter.h"
#include "tests/unit/drivers/gpio_axis/axis_bench.h"

namespace tactus::drivers {
namespace {

GpioAxisConfig counter_config() {
  GpioAxisConfig config = full_config();
  config.encoder.counter_ceiling = 9999;
  config.encoder.counter_index = true;
  config.pins.encoder_a.reset();
  config.pins.encoder_b.reset();
  config.pins.encoder_index.reset();
  return config;
}

class CounterAxis : public ::testing::Test {
 protected:
  CounterAxis() {
    clock_.advance_by(10 * kBenchTick_ns);
    axis_.start();
    ticks(3);
    EXPECT_EQ(sample_.status, kDeviceOk) << axis_.trouble(0).what;
  }
  void tick(std::int64_t steps = 0) {
    counter_.move(steps);
    clock_.advance_by(kBenchTick_ns);
    axis_.read(std::span(&sample_, 1), hal::kNoWait);
    axis_.write(std::span(&kPush, 1));
    emulator_.run(clock_.now_ns());
  }
  void ticks(int count, std::int64_t steps = 0) {
    for (int i = 0; i < count; ++i) {
      tick(steps);
    }
  }
  double torque() const { return emulator_.shaft().torque_Nm; }
  void expect_fault(std::uint32_t status, GpioAxisTrouble trouble) {
    EXPECT_NE(sample_.status & status, 0U);
    EXPECT_EQ(axis_.trouble(0).code, code_of(trouble));
    EXPECT_EQ(torque(), 0.0);
  }

  GpioAxisConfig config_ = counter_config();
  hal::SimulatedClock clock_;
  hal::SimulatedGpioChip chip_{clock_};
  hal::SimulatedGpioLines lines_{chip_};
  hal::SimulatedPwmOutput pwm_{clock_};
  hal::SimulatedCounter counter_{clock_};
  host::SimulatedPins pins_{chip_, pwm_};
  host::GpioAxisEmulator emulator_{config_, pins_, 1};
  GpioAxis axis_{config_, counter_, lines_, pwm_, clock_};
  AxisSample sample_;
};

TEST_F(CounterAxis, FollowsTheCounterOverItsWrap) {
  for (int i = 0; i < 1200; ++i) {
    tick(10);
    if (i % 200 == 150) {
      counter_.pulse_index();
    }
  }
  EXPECT_EQ(sample_.status, kDeviceOk) << axis_.trouble(0).what;
  EXPECT_NEAR(sample_.position_rad, 12'000.0 * 2.0 * std::numbers::pi / 2000.0, 1e-9);
  EXPECT_NEAR(sample_.velocity_rad_per_s, 10'000.0 * 2.0 * std::numbers::pi / 2000.0, 1e-6);
  EXPECT_TRUE(sample_.index_seen);
  EXPECT_GT(torque(), 0.0);
}

TEST_F(CounterAxis, AJumpIsAFaultAndNoPosition) {
  const double before_rad = sample_.position_rad;
  tick(500);
  expect_fault(kDeviceEncoderFault | kDeviceReferenceLost, GpioAxisTrouble::jump);
  EXPECT_EQ(sample_.position_rad, before_rad);
}

TEST_F(CounterAxis, NoiseIsAFault) {
  counter_.set_noisy(true);
  tick();
  expect_fault(kDeviceEncoderFault | kDeviceReferenceLost, GpioAxisTrouble::noise);
}

TEST_F(CounterAxis, AMissingCounterIsALostDeviceAndComesBackWithAReset) {
  counter_.remove();
  tick();
  expect_fault(kDeviceLost | kDeviceReferenceLost, GpioAxisTrouble::counter_gone);
  counter_.plug_in();
  axis_.clear_faults();
  ticks(2);
  EXPECT_EQ(sample_.status, kDeviceOk);
  EXPECT_GT(torque(), 0.0);
}

TEST_F(CounterAxis, LostEdgesOfSafetyLinesCountAsAnEmergencyStop) {
  lines_.lose_next_edges(2);
  emulator_.open_emergency_stop(true);
  emulator_.open_emergency_stop(false);
  tick();
  EXPECT_GT(torque(), 0.0) << "nothing tells of it yet";
  chip_.drive(1, false);
  chip_.drive(1, true);
  tick();
  expect_fault(kDeviceEmergencyStop, GpioAxisTrouble::safety_edges_lost);
}

TEST_F(CounterAxis, EmergencyStopActsOnItsFirstEdge) {
  emulator_.open_emergency_stop(true);
  emulator_.open_emergency_stop(false);
  tick();
  expect_fault(kDeviceEmergencyStop, GpioAxisTrouble::emergency_stop);
}

}  // namespace
}  // namespace tactus::drivers
