// Which identifiers the drives on a CAN bus use.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/device/device_config.h"

namespace tactus::firmware {

struct CanIdentifier {
  std::uint32_t id = 0;
  bool extended = false;

  bool operator==(const CanIdentifier&) const = default;
};

// The key of the drive's number on its bus; empty for an axis that is not on CAN.
std::string_view number_key(const AxisConfig& axis);

// Whether both are of one driver and would answer to the same number, or one to the number of the
// other's host.
bool have_same_number(const AxisConfig& one, const AxisConfig& other);

// An identifier that both use, of drives of different drivers.
std::optional<CanIdentifier> shared_identifier(const AxisConfig& one, const AxisConfig& other);

}  // namespace tactus::firmware
