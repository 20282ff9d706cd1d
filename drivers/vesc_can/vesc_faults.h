// The fault codes of a VESC, in words.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::vesc {

// Returns the words and a remedy, or an empty Trouble for 0.
Trouble fault_trouble(std::uint8_t code);
// Returns true for codes of the supply, of a restart or of the sensor. After them the tachometer
// may count from another zero.
bool loses_reference(std::uint8_t code);

}  // namespace tactus::drivers::vesc
