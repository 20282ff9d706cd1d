// Finds the identifiers that the drives on a CAN bus use, and their collisions.
#pragma once

#include <optional>
#include <string_view>

#include "drivers/common/can_identifiers.h"
#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Returns the key of the drive's number on its bus; empty for an axis that is not on CAN.
std::string_view number_key(const AxisConfig& axis);

// Returns true if both have the same driver and would answer to the same number, or if one would
// answer to the number of the other's host.
bool have_same_number(const AxisConfig& one, const AxisConfig& other);

// Returns an identifier that both use, if their drivers differ.
std::optional<drivers::CanIdentifier> shared_identifier(const AxisConfig& one,
                                                        const AxisConfig& other);

}  // namespace tactus::firmware
