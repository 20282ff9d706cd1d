// Facts about this machine that stand in no file of /proc or /sys. Machine calls these functions
// when it is not a recorded machine; each returns nothing if the fact cannot be found out.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host_tools/doctor/machine.h"

namespace tactus::host {

// Returns true if this process may write to `path`, by access(2), so that groups, capabilities and
// access lists count; nothing if there is no such file.
std::optional<bool> live_writable(std::string_view path);

// Returns the label that a GPIO chip's driver gives it, such as "pinctrl-bcm2711" for "gpiochip0";
// nothing if the chip may not be opened.
std::optional<std::string> live_gpio_label(std::string_view chip);

// Returns what `ip -details -json link show INTERFACE` prints; nothing if the program or the
// interface is missing.
std::optional<std::string> live_ip_link(std::string_view interface);

// Returns the delay of an interface's interrupts; nothing if its driver has none to set.
std::optional<InterruptDelay> live_interrupt_delay(std::string_view interface);

}  // namespace tactus::host
