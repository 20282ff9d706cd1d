// The configuration of a Pivot drive on a CAN bus.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"

namespace tactus::drivers {

// The settings of one drive. Angles and torque are those of the motor's shaft.
struct PivotConfig {
  std::uint8_t node = 1;               // 1 to 15
  double max_torque_Nm = 0.1;          // clamps every command; above 0, up to 5
  double max_speed_rad_per_s = 200.0;  // a faster shaft is an encoder fault; 1 to 1000
  double counts_per_turn = 8192.0;     // 4 to 1000000
  double lost_after_s = 0.005;         // the longest time without a position; 0.002 to 1
  bool unproven_watchdog = false;      // the owner accepts that the drive has no watchdog
};

// Returns the keys of device.toml.
std::span<const Binding<PivotConfig>> pivot_keys();

// Checks every field against its range.
Checked check(const PivotConfig& config);

}  // namespace tactus::drivers
