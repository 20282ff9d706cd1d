// The error codes of emergency messages and of object 603F, in words.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::cia402 {

// What the drive reports and what to do about it; the code itself in `code`. Codes that makers
// define for themselves give the class that the code belongs to.
Trouble error_code_trouble(std::uint16_t code);

// True for codes of a supply, of the encoder and of a restarted program: the position may count
// from another zero.
bool may_move_zero(std::uint16_t code);

// True for codes by which a drive says that the host fell silent.
bool is_host_silent(std::uint16_t code);

}  // namespace tactus::drivers::cia402
