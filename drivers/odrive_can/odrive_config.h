// The configuration of one ODrive axis on a CAN bus.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"

namespace tactus::drivers {

// The source of position estimates: the drive's own clock, or a request in each tick. A request
// costs a frame and an answer a tick, but gives samples of the same age.
enum class ODriveEstimates : std::uint8_t { cyclic, requested };
constexpr auto setting_words(ODriveEstimates /*of*/) {
  return std::to_array<Word<ODriveEstimates>>(
      {{"cyclic", ODriveEstimates::cyclic}, {"requested", ODriveEstimates::requested}});
}

// The settings of one axis. Angles and torque are those of the motor shaft.
struct ODriveConfig {
  std::uint8_t node_id = 0;            // 0 to 62
  double max_torque_Nm = 0.2;          // clamps every command; above 0, up to 100
  double max_speed_rad_per_s = 200.0;  // larger than any real speed of the shaft: 0.1 to 10000
  double jump_margin_rad = 0.05;       // on top of it, between two estimates: above 0, up to 3

  // The drive's own limits, sent before closed loop. 0 leaves both as they are in the drive. In
  // torque mode the drive reduces its torque near its speed limit, so that limit must be well above
  // max_speed_rad_per_s.
  double drive_speed_limit_rad_per_s = 0.0;  // up to 100000
  double drive_current_limit_A = 0.0;        // up to 200

  // The time of the drive's watchdog, as it is set in the drive. CANSimple cannot set it; README.md
  // explains how to. The bring-up proves that the watchdog takes the torque away in that time.
  double watchdog_s = 0.02;  // 0.001 to 1
  // True: the owner accepts a drive whose watchdog was not proven, so that the motor may keep its
  // torque for ever when the host dies.
  bool unproven_watchdog = false;

  // The interval at which the drive is asked for its torque, if it can report one; 0: never. Up to
  // 10 s.
  double torque_period_s = 0.01;
  // Firmware 0.5 reports only a current, and this constant (the drive's own torque_constant)
  // converts it to a torque. 0: not known, and the sample has no torque. Firmware 0.6 reports
  // torque. Up to 10.
  double torque_constant_Nm_per_A = 0.0;

  ODriveEstimates estimates = ODriveEstimates::cyclic;
  // Set it to false for USB adapters that cannot send remote frames.
  bool ask_by_remote_frame = true;

  // The deadlines, 0.001 to 10 s. They must rise in this order.
  double estimate_stale_s = 0.0022;  // kDeviceStale
  double estimate_lost_s = 0.0034;   // kDeviceLost
  double heartbeat_lost_s = 0.35;    // kDeviceLost; three of the drive's heartbeat periods
  double bring_up_s = 2.0;           // for each step of the bring-up
  // The interval at which one of errors, temperature and supply is asked for, in turn; 0: never. Up
  // to 10 s.
  double poll_period_s = 0.1;
};

// Returns the keys of device.toml.
std::span<const Binding<ODriveConfig>> odrive_keys();

// Checks every field against its range.
Checked check(const ODriveConfig& config);

}  // namespace tactus::drivers
