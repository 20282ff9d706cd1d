// The errors of an ODrive in words: every bit of either generation.
//
// If several bits are set, the words are those of the most specific one. The `code` of the result
// is the whole error word. For a motor error beyond 32 bits it is the upper half.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::odrive {

// These return the words for firmware 0.5.x. The error must not be zero.
Trouble axis_trouble(std::uint32_t error);
Trouble motor_trouble(std::uint64_t error);
Trouble encoder_trouble(std::uint32_t error);
Trouble controller_trouble(std::uint32_t error);
// Returns true if an axis error only names the part that has the error.
bool is_explained_elsewhere(std::uint32_t axis_error);

// Returns the words for active errors or a disarm reason of firmware 0.6.x. The error must not be
// zero.
Trouble active_trouble(std::uint32_t error);
// Returns the reason why the drive did not reach closed loop; an empty Trouble for success and
// busy.
Trouble procedure_trouble(std::uint8_t result);

// These return true for errors of the supply, of a restart or of the encoder. After them the
// position may count from another zero.
bool loses_reference_0_5(std::uint32_t axis_error);
bool motor_loses_reference(std::uint64_t motor_error);
bool controller_loses_reference(std::uint32_t controller_error);
bool loses_reference_0_6(std::uint32_t error);

// These return true if the drive reports that its watchdog expired.
bool is_watchdog_0_5(std::uint32_t axis_error);
bool is_watchdog_0_6(std::uint32_t error);

// These return true if the drive reports that somebody asked for an emergency stop.
bool is_emergency_stop_0_5(std::uint32_t axis_error);
bool is_emergency_stop_0_6(std::uint32_t error);

}  // namespace tactus::drivers::odrive
