// The fault codes of a VESC, in words.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::vesc {

// Nothing for 0.
Trouble fault_trouble(std::uint8_t code);
// Whether the code tells of the supply, of a restart or of the sensor: the tachometer may have
// another zero afterwards.
bool loses_reference(std::uint8_t code);

}  // namespace tactus::drivers::vesc
