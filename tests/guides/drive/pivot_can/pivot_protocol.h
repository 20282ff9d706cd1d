// The frames of a Pivot drive. A command has the torque as a whole number of 1 / 1000 N m, and an
// answer the encoder's counts as a whole number of 32 bits. Both are little-endian.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/can_frame.h"

namespace tactus::drivers::pivot {

constexpr std::uint32_t command_id(std::uint8_t node) {
  return 0x300U + node;
}
constexpr std::uint32_t answer_id(std::uint8_t node) {
  return 0x380U + node;
}

inline constexpr int kCommandBytes = 2;
inline constexpr int kAnswerBytes = 4;

// `torque_Nm` lies between -32 and 32.
hal::CanFrame command(std::uint8_t node, double torque_Nm);

// Returns the counts of an answer of that node; nothing for any other frame.
std::optional<std::int32_t> counts_of(const hal::CanFrame& frame, std::uint8_t node);

}  // namespace tactus::drivers::pivot
