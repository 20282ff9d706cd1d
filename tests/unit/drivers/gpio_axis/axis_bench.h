// An axis and its emulator on simulated pins, ticked at 1 kHz.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <numbers>

#include "drivers/gpio_axis/gpio_axis.h"
#include "hal/simulated/gpio_lines.h"
#include "hal/simulated/pwm_output.h"
#include "host_tools/emulators/gpio_axis_emulator.h"
#include "host_tools/emulators/simulated_pins.h"

namespace tactus::drivers {

inline constexpr hal::TimeNs kBenchTick_ns = 1'000'000;

// Every line connected, on offsets out of order, some active low.
inline GpioAxisConfig full_config() {
  GpioAxisConfig config;
  config.encoder = {.counts_per_rev = 2000, .max_speed_rad_per_s = 100.0};
  config.bridge = {.full_duty_torque_Nm = 0.05,
                   .max_torque_Nm = 0.04,
                   .pwm_period_ns = 40'000,
                   .direction_dead_us = 0};
  config.pins.encoder_a = InputPin{.offset = 7};
  config.pins.encoder_b = InputPin{.offset = 3};
  config.pins.encoder_index = InputPin{.offset = 12, .active_low = true};
  config.pins.fault = InputPin{.offset = 1, .active_low = true, .bias = hal::GpioBias::pull_down};
  config.pins.emergency_stop = InputPin{.offset = 2, .bias = hal::GpioBias::pull_up};
  config.pins.limit_low = InputPin{.offset = 4, .bias = hal::GpioBias::pull_up};
  config.pins.limit_high = InputPin{.offset = 5, .bias = hal::GpioBias::pull_up};
  config.pins.direction = OutputPin{.offset = 8};
  config.pins.enable = OutputPin{.offset = 9, .active_low = true};
  config.pins.brake_release = OutputPin{.offset = 10};
  config.pins.heartbeat = OutputPin{.offset = 11};
  config.torque_ramp_ms = 0;
  return config;
}

class AxisBench {
 public:
  explicit AxisBench(const GpioAxisConfig& config = full_config())
      : emulator(config, pins, 1), axis(config, lines, pwm, clock) {
    clock.advance_by(10 * kBenchTick_ns);
    axis.start();
  }

  // One tick: the plant moves in 100 steps, then read and write. `motion` gives the shaft's
  // position for a time.
  void tick(const AxisCommand& command, const std::function<double(double)>& motion = nullptr) {
    run_plant(motion);
    axis.read(std::span(&sample, 1), hal::kNoWait);
    axis.write(std::span(&command, 1));
    emulator.run(clock.now_ns());
  }
  void ticks(int count, const AxisCommand& command,
             const std::function<double(double)>& motion = nullptr) {
    for (int i = 0; i < count; ++i) {
      tick(command, motion);
    }
  }
  void run_plant(const std::function<double(double)>& motion = nullptr) {
    for (int i = 0; i < 100; ++i) {
      clock.advance_by(kBenchTick_ns / 100);
      if (motion) {
        emulator.shaft().position_rad = motion(1e-9 * static_cast<double>(clock.now_ns()));
      }
      emulator.run(clock.now_ns());
    }
  }
  [[nodiscard]] double torque() const { return emulator.shaft().torque_Nm; }
  [[nodiscard]] std::uint32_t code() const { return axis.trouble(0).code; }
  [[nodiscard]] bool is_enabled() const { return !chip.level(9); }

  hal::SimulatedClock clock;
  hal::SimulatedGpioChip chip{clock};
  hal::SimulatedGpioLines lines{chip};
  hal::SimulatedPwmOutput pwm{clock};
  host::SimulatedPins pins{chip, pwm};
  host::GpioAxisEmulator emulator;
  GpioAxis axis;
  AxisSample sample;
};

inline constexpr double kCount_rad = 2.0 * std::numbers::pi / 2000.0;  // of full_config

inline constexpr AxisCommand kPush{.torque_Nm = 0.02, .enable = true};
inline constexpr AxisCommand kIdleOn{.torque_Nm = 0.0, .enable = true};

inline std::uint32_t code_of(GpioAxisTrouble trouble) {
  return static_cast<std::uint32_t>(trouble);
}

}  // namespace tactus::drivers
