// A line of a GPIO chip as text: its number, then how it is wired: "4", "4 active_low pull_up".
#pragma once

#include <string_view>

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "firmware/device/setting.h"

namespace tactus::firmware {

// The pin that the setting names; an error's words, or none.
std::string_view assign(drivers::InputPin& pin, const Setting& setting);
std::string_view assign(drivers::OutputPin& pin, const Setting& setting);

}  // namespace tactus::firmware
