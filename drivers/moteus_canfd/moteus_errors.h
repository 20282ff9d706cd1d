// The fault codes of a moteus, in words.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::moteus {

// Returns true for the codes that name a limit on the torque and are no faults: 96 velocity, 97
// power, 98 supply voltage, 99 current, 100 board temperature, 101 motor temperature, 102 commanded
// maximum torque, 103 position.
constexpr bool is_limit(std::uint8_t code) {
  constexpr std::uint8_t kFirst = 96;
  constexpr std::uint8_t kLast = 103;
  return code >= kFirst && code <= kLast;
}

// Returns the words and the remedy of a code that is neither 0 nor a limit.
Trouble fault_trouble(std::uint8_t code);

}  // namespace tactus::drivers::moteus
