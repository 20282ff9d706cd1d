// Finds the means that takes a motor's torque away when the host dies: its program killed, its
// kernel stopped or its power gone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

enum class MotorStop : std::uint8_t {
  drive_watchdog,  // the drive's own watchdog, which the bring-up proves
  heartbeat_line,  // a circuit on the axis' heartbeat line
  watchdog_line,   // a circuit on the device's watchdog line
  nothing,
};

// Returns the means for an axis. `axis` is an index into config.axes.
MotorStop motor_stop(const DeviceConfig& config, std::size_t axis);

// Returns true if the owner accepts, by unproven_watchdog = true, that nothing was proven to stop
// the motor.
bool accepts_unproven_watchdog(const DeviceConfig& config, std::size_t axis);

}  // namespace tactus::firmware
