// The errors of an ODrive in words: every bit of either generation.
//
// Where several bits are set the words are those of the most telling one. The code of the result is
// the whole error word; for a motor error that lies beyond 32 bits, its upper half.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers::odrive {

// Firmware 0.5.x; all take a word that is not zero.
Trouble axis_trouble(std::uint32_t error);
Trouble motor_trouble(std::uint64_t error);
Trouble encoder_trouble(std::uint32_t error);
Trouble controller_trouble(std::uint32_t error);
// Whether an axis error only says which part has the error.
bool is_explained_elsewhere(std::uint32_t axis_error);

// Firmware 0.6.x: of active errors or of a disarm reason; a word that is not zero.
Trouble active_trouble(std::uint32_t error);
// Why the drive did not reach closed loop; nothing for success and busy.
Trouble procedure_trouble(std::uint8_t result);

// Whether the word tells of the supply, of a restart or of the encoder: the position may have
// another zero afterwards.
bool loses_reference_0_5(std::uint32_t axis_error);
bool motor_loses_reference(std::uint64_t motor_error);
bool controller_loses_reference(std::uint32_t controller_error);
bool loses_reference_0_6(std::uint32_t error);

// Whether the word says that the drive's watchdog expired.
bool is_watchdog_0_5(std::uint32_t axis_error);
bool is_watchdog_0_6(std::uint32_t error);

// Whether the word says that somebody asked for an emergency stop.
bool is_emergency_stop_0_5(std::uint32_t axis_error);
bool is_emergency_stop_0_6(std::uint32_t error);

}  // namespace tactus::drivers::odrive
