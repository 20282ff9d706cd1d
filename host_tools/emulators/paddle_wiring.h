// The lines of an emulated paddle, in a user's words.
#pragma once

#include <span>
#include <string>

#include "drivers/gpio_axis/gpio_axis_config.h"

namespace tactus::host {

// "encoder_a=0", "emergency_stop=5:active_low": the names of the lines as device.toml has them.
// Throws InputError on a name, a number or a word that is none, and on a line given twice.
drivers::AxisPins parse_pins(std::span<const std::string> texts);

}  // namespace tactus::host
