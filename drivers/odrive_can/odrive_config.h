// One ODrive axis on a CAN bus, as its owner set it up.
#pragma once

#include <cstdint>

#include "drivers/field_error.h"

namespace tactus::drivers {

// How position estimates come: by the drive's own clock, or each time we ask. Asking costs a frame
// and a drive's answer a tick, but gives samples of the same age.
enum class ODriveEstimates : std::uint8_t { cyclic, requested };

struct ODriveConfig {
  std::uint8_t node_id = 0;            // 0 to 62
  double max_torque_Nm = 0.2;          // clamps every command; above 0, up to 100
  double max_speed_rad_per_s = 200.0;  // faster than the shaft ever turns: 0.1 to 10000
  double jump_margin_rad = 0.05;       // on top of it, between two estimates: above 0, up to 3

  // The drive's own limits, sent before closed loop; 0 leaves both as they are in the drive. In
  // torque mode the drive takes its torque back near its speed limit, so it has to be well above
  // max_speed_rad_per_s.
  double drive_speed_limit_rad_per_s = 0.0;  // up to 100000
  double drive_current_limit_A = 0.0;        // up to 200

  // The drive's watchdog, as it is set in the drive: CANSimple cannot set it, README.md says how.
  // The bring-up proves that it takes the torque away in that time.
  double watchdog_s = 0.02;  // 0.001 to 1
  // True: the owner accepts a drive whose watchdog was not proven, and with it that the motor may
  // keep its torque for ever when the host dies.
  bool unproven_watchdog = false;

  // How often the drive's torque is asked for, where it is known; 0: never. Up to 10 s.
  double torque_period_s = 0.01;
  // Firmware 0.5 reports current alone: the drive's own torque_constant makes a torque of it. 0:
  // not known, and the sample then has no torque. 0.6 reports torque. Up to 10.
  double torque_constant_Nm_per_A = 0.0;

  ODriveEstimates estimates = ODriveEstimates::cyclic;
  // False for USB adapters that cannot send remote frames.
  bool ask_by_remote_frame = true;

  // Deadlines, 0.001 to 10 s, in this order.
  double estimate_stale_s = 0.0022;  // kDeviceStale
  double estimate_lost_s = 0.0034;   // kDeviceLost
  double heartbeat_lost_s = 0.35;    // kDeviceLost; three of the drive's heartbeat periods
  double bring_up_s = 2.0;           // for each step of the bring-up
  // How often one of errors, temperature and supply is asked for, in turn; 0: never. Up to 10 s.
  double poll_period_s = 0.1;
};

Checked check(const ODriveConfig& config);

}  // namespace tactus::drivers
