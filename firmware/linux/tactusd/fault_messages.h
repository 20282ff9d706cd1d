// Prints to stderr what went wrong at a device, with the remedy. Not real time.
#pragma once

#include <cstdint>

#include "drivers/composition/composed_device.h"
#include "firmware/linux/tactusd/linux_boards.h"

namespace tactus::firmware {

// Prints why a board could not be opened. `image` is the file of the device.
void complain(const char* image, const OpenError& error);

// Prints the latched faults (faults.h), the joint in trouble and the joint that lost its reference.
void explain_fault(std::uint64_t faults, const drivers::ComposedDevice& device);

}  // namespace tactus::firmware
