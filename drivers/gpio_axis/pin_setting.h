// Reads a line of a GPIO chip from text: its number, then its wiring, as "4" or "4 active_low
// pull_up".
#pragma once

#include <string_view>

#include "drivers/common/setting.h"
#include "drivers/gpio_axis/gpio_axis_config.h"

namespace tactus::drivers {

// These read a pin from a setting. They return an error in words, or an empty text.
std::string_view assign(InputPin& pin, const Setting& setting);
std::string_view assign(OutputPin& pin, const Setting& setting);

}  // namespace tactus::drivers
