// Finds the identifiers that the drives on a CAN bus use, and their collisions.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// An identifier of 11 bits, or of 29 bits if extended.
struct CanIdentifier {
  std::uint32_t id = 0;
  bool extended = false;

  bool operator==(const CanIdentifier&) const = default;
};

// Returns the key of the drive's number on its bus; empty for an axis that is not on CAN.
std::string_view number_key(const AxisConfig& axis);

// Returns true if both have the same driver and would answer to the same number, or if one would
// answer to the number of the other's host.
bool have_same_number(const AxisConfig& one, const AxisConfig& other);

// Returns an identifier that both use, if their drivers differ.
std::optional<CanIdentifier> shared_identifier(const AxisConfig& one, const AxisConfig& other);

}  // namespace tactus::firmware
