#include "hal/simulated/gpio_chip.h"

#include <algorithm>

#include "hal/simulated/gpio_lines.h"

namespace tactus::hal {

SimulatedGpioChip::SimulatedGpioChip(SimulatedClock& clock, std::size_t line_count)
    : clock_(clock), line_count_(std::min(line_count, kMaxGpioLines)) {}

void SimulatedGpioChip::drive(std::size_t offset, bool high) {
  pins_[offset].outside = high ? Outside::high : Outside::low;
  update(offset);
}

void SimulatedGpioChip::leave_open(std::size_t offset) {
  pins_[offset].outside = Outside::open;
  update(offset);
}

bool SimulatedGpioChip::resolve(const Pin& pin) {
  if (pin.holder != nullptr && pin.config.direction == GpioDirection::output) {
    const bool high = pin.output_active != pin.config.active_low;
    // An open-drain output only pulls low, an open-source output only high; else the pin floats.
    const bool left_open = (pin.config.drive == GpioDrive::open_drain && high) ||
                           (pin.config.drive == GpioDrive::open_source && !high);
    if (!left_open) {
      return high;
    }
  }
  if (pin.outside != Outside::open) {
    return pin.outside == Outside::high;
  }
  return pin.holder != nullptr && pin.config.bias == GpioBias::pull_up;
}

void SimulatedGpioChip::update(std::size_t offset) {
  Pin& pin = pins_[offset];
  const bool level = resolve(pin);
  if (level == pin.level) {
    return;
  }
  pin.level = level;
  if (pin.holder != nullptr && pin.config.direction == GpioDirection::input) {
    pin.holder->level_changed(pin.index, level);
  }
}

}  // namespace tactus::hal
