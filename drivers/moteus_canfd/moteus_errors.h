// The fault codes of a moteus in words.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/axis.h"

namespace tactus::drivers::moteus {

// Codes that say what holds the torque back now, without being faults.
constexpr bool is_limit(std::uint8_t code) {
  constexpr std::uint8_t kFirst = 96;
  constexpr std::uint8_t kLast = 103;
  return code >= kFirst && code <= kLast;
}

// For a code that is neither 0 nor a limit.
Trouble fault_trouble(std::uint8_t code);

// "the motor's temperature", for a limit; otherwise nothing.
std::string_view limit_words(std::uint8_t code);

}  // namespace tactus::drivers::moteus
