// Reads the wiring of an emulated paddle in the user's words, for `tactus emulate paddle --pins`.
#pragma once

#include <span>
#include <string>

#include "drivers/gpio_axis/gpio_axis_config.h"

namespace tactus::host {

// Returns the pins of texts like "encoder_a=0" or "emergency_stop=5:active_low"; the names are
// those of device.toml. Throws InputError for an unknown name, a line number out of range, and a
// line that is given twice.
drivers::AxisPins parse_pins(std::span<const std::string> texts);

}  // namespace tactus::host
