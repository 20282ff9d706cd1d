// The outside of a board's pins, to which an emulated encoder, switch or bridge is wired. It is
// implemented in memory (simulated_pins.h) and on the kernel's gpio-sim (gpio_sim_pins.h).
#pragma once

#include <cstdint>

namespace tactus::host {

// All levels are physical, high or low, whatever a driver calls active. The functions throw
// InputError if the system refuses.
class BoardPins {
 public:
  BoardPins() = default;
  BoardPins(const BoardPins&) = delete;
  BoardPins& operator=(const BoardPins&) = delete;
  virtual ~BoardPins() = default;

  // Sets the level of a line that is an input of the board.
  virtual void drive(std::uint32_t offset, bool high) = 0;
  // Returns the level of a line that is an output of the board.
  virtual bool level(std::uint32_t offset) = 0;
  // Returns the share of the time, 0 to 1, in which the PWM output is high.
  virtual double pwm_level() = 0;
  // Removes the chip from the board.
  virtual void unplug() = 0;
};

}  // namespace tactus::host
