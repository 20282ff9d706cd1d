// Remedies for a Raspberry Pi: its firmware reads the kernel's command line and the overlays of the
// device tree from /boot/firmware, where other machines have a boot loader.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/doctor/machine.h"

namespace tactus::host {

// Returns true if the machine's device tree says that it is one.
bool is_raspberry_pi(Machine& machine);

// Return the command that adds a line to the firmware's configuration, or words to the kernel's
// command line, and starts the board anew.
std::string add_firmware_line(std::string_view line);
std::string add_kernel_words(std::string_view words);

}  // namespace tactus::host
