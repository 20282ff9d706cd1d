// Facts about this machine that are not in its files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tactus::host {

// Returns whether the user may write to `path`, by access(2), so that groups, capabilities and
// access lists count.
std::optional<bool> live_writable(std::string_view path);

// Returns the label of a chip: "pinctrl-bcm2711" for "gpiochip0".
std::optional<std::string> live_gpio_label(std::string_view chip);

// Returns the output of `ip -details -json link show INTERFACE`.
std::optional<std::string> live_ip_link(std::string_view interface);

}  // namespace tactus::host
