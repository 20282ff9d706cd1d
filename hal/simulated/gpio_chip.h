// The pins of a simulated GPIO chip, as seen from outside the board. One thread; see
// simulated/clock.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/gpio_lines.h"
#include "hal/simulated/clock.h"

namespace tactus::hal {

class SimulatedGpioLines;

// A chip with up to 64 pins.
//
// Simulated: pins that are driven from outside or left open, pulls, open-drain and open-source
// outputs, lines held by one request at a time, removal of the chip. Not simulated: currents. An
// output wins over an outside driver; an open pin without a pull is low.
class SimulatedGpioChip {
 public:
  // Makes a chip with that many pins, at most kMaxGpioLines. The clock must outlive it.
  explicit SimulatedGpioChip(SimulatedClock& clock, std::size_t line_count = kMaxGpioLines);

  // Connects the pin to a driver outside the board. Levels here are physical, independent of
  // active-low. The offset must be below the line count.
  void drive(std::size_t offset, bool high);
  // Disconnects the pin from the outside driver: its pull or the board's output decides the level.
  void leave_open(std::size_t offset);
  // Returns the physical level of the pin.
  bool level(std::size_t offset) const { return pins_[offset].level; }

  // Makes every call of a request return `disconnected` for good.
  void remove() { present_ = false; }

  SimulatedClock& clock() { return clock_; }
  std::size_t line_count() const { return line_count_; }

 private:
  friend class SimulatedGpioLines;

  enum class Outside : std::uint8_t { open, low, high };
  // A pin with what drives it and the request that holds it.
  struct Pin {
    Outside outside = Outside::open;
    // The physical level that results.
    bool level = false;
    // The logical level that the holder has set.
    bool output_active = false;
    GpioLineConfig config;
    SimulatedGpioLines* holder = nullptr;
    // The index of the line in the holder's request.
    std::size_t index = 0;
  };

  // Returns the level that the output, the outside driver and the pull give together.
  static bool resolve(const Pin& pin);
  // Computes the level anew and tells the holder if it changed.
  void update(std::size_t offset);

  SimulatedClock& clock_;
  std::size_t line_count_;
  std::array<Pin, kMaxGpioLines> pins_{};
  bool present_ = true;
};

}  // namespace tactus::hal
