#include "firmware/device_file/motor_stop.h"

namespace tactus::firmware {

MotorStop motor_stop(const DeviceConfig& config, std::size_t axis) {
  return drivers::visit_drive(config.axes[axis].drive, [&](const auto& driver, const auto& drive) {
    if (driver.has_heartbeat != nullptr && driver.has_heartbeat(drive)) {
      return MotorStop::heartbeat_line;
    }
    if (driver.watchdog_s != nullptr) {
      return MotorStop::drive_watchdog;
    }
    return config.watchdog_line ? MotorStop::watchdog_line : MotorStop::nothing;
  });
}

bool accepts_unproven_watchdog(const DeviceConfig& config, std::size_t axis) {
  const AxisConfig& motor = config.axes[axis];
  const bool board_accepts = drivers::visit_connection(
      config.connections[motor.connection].line, [](const auto& kind, const auto& line) {
        return kind.accepts_unproven_watchdog != nullptr && kind.accepts_unproven_watchdog(line);
      });
  const bool drive_accepts =
      drivers::visit_drive(motor.drive, [](const auto& /*driver*/, const auto& drive) {
        if constexpr (requires { drive.unproven_watchdog; }) {
          return drive.unproven_watchdog;
        } else {
          return false;
        }
      });
  return board_accepts || drive_accepts;
}

}  // namespace tactus::firmware
