// The outside of a board's pins: what an emulated encoder, switch or bridge is wired to.
#pragma once

#include <cstdint>

namespace tactus::host {

// Physical levels: high or low, whatever active-low says on the other side. Throws InputError where
// the system refuses.
class BoardPins {
 public:
  BoardPins() = default;
  BoardPins(const BoardPins&) = delete;
  BoardPins& operator=(const BoardPins&) = delete;
  virtual ~BoardPins() = default;

  // Drives an input of the board.
  virtual void drive(std::uint32_t offset, bool high) = 0;
  // Senses an output of the board.
  virtual bool level(std::uint32_t offset) = 0;
  // The part of the time from 0 to 1 that the PWM output is high.
  virtual double pwm_level() = 0;
  // The chip leaves the board.
  virtual void unplug() = 0;
};

}  // namespace tactus::host
