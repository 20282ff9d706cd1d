// The outside of a simulated GPIO chip and PWM channel, for tests in simulated time.
#pragma once

#include "hal/simulated/gpio_chip.h"
#include "hal/simulated/pwm_output.h"
#include "host_tools/emulators/board_pins.h"

namespace tactus::host {

// Connects an emulator to the simulated hal.
class SimulatedPins final : public BoardPins {
 public:
  // Chip and PWM channel must outlive it.
  SimulatedPins(hal::SimulatedGpioChip& chip, const hal::SimulatedPwmOutput& pwm)
      : chip_(chip), pwm_(pwm) {}

  void drive(std::uint32_t offset, bool high) override { chip_.drive(offset, high); }
  bool level(std::uint32_t offset) override { return chip_.level(offset); }
  double pwm_level() override { return pwm_.mean_level(); }
  void unplug() override { chip_.remove(); }

 private:
  hal::SimulatedGpioChip& chip_;
  const hal::SimulatedPwmOutput& pwm_;
};

}  // namespace tactus::host
