// The pins of a simulated GPIO chip, as seen from outside the board.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/gpio_lines.h"
#include "hal/simulated/clock.h"

namespace tactus::hal {

class SimulatedGpioLines;

// Simulated: pins that are driven from outside or left open, pulls, open-drain and open-source
// outputs, lines held by one request at a time, removal of the chip.
// Not simulated: currents. An output wins over an outside driver; an open pin without a pull is
// low.
class SimulatedGpioChip {
 public:
  explicit SimulatedGpioChip(SimulatedClock& clock, std::size_t line_count = kMaxGpioLines);

  // Levels here are physical, independent of active-low. The offset must be below the line count.
  void drive(std::size_t offset, bool high);
  void leave_open(std::size_t offset);
  bool level(std::size_t offset) const { return pins_[offset].level; }

  // Makes every call of a request return `disconnected` from now on.
  void remove() { present_ = false; }

  SimulatedClock& clock() { return clock_; }
  std::size_t line_count() const { return line_count_; }

 private:
  friend class SimulatedGpioLines;

  enum class Outside : std::uint8_t { open, low, high };
  struct Pin {
    Outside outside = Outside::open;
    bool level = false;
    bool output_active = false;
    GpioLineConfig config;
    SimulatedGpioLines* holder = nullptr;
    std::size_t index = 0;  // index of the line in the holder's request
  };

  static bool resolve(const Pin& pin);
  void update(std::size_t offset);

  SimulatedClock& clock_;
  std::size_t line_count_;
  std::array<Pin, kMaxGpioLines> pins_{};
  bool present_ = true;
};

}  // namespace tactus::hal
