// The error codes of emergency messages and of object 603F, in words.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::cia402 {

// Returns the error in words with a remedy; `code` is the error code itself. A code that a maker
// defined gets the words of its class.
Trouble error_code_trouble(std::uint16_t code);

// Returns true for codes of a supply, of the encoder and of a restarted program, after which the
// position may count from another zero.
bool may_move_zero(std::uint16_t code);

// Returns true for codes with which a drive reports that the host fell silent.
bool is_host_silent(std::uint16_t code);

}  // namespace tactus::drivers::cia402
