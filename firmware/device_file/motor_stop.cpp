#include "firmware/device_file/motor_stop.h"

#include <variant>

namespace tactus::firmware {

MotorStop motor_stop(const DeviceConfig& config, std::size_t axis) {
  const auto& drive = config.axes[axis].drive;
  if (const auto* gpio = std::get_if<drivers::GpioAxisConfig>(&drive);
      gpio != nullptr && gpio->pins.heartbeat) {
    return MotorStop::heartbeat_line;
  }
  if (!std::holds_alternative<BoardAxis>(drive) &&
      !std::holds_alternative<drivers::GpioAxisConfig>(drive)) {
    return MotorStop::drive_watchdog;
  }
  return config.watchdog_line ? MotorStop::watchdog_line : MotorStop::nothing;
}

bool accepts_unproven_watchdog(const DeviceConfig& config, std::size_t axis) {
  const AxisConfig& motor = config.axes[axis];
  const auto& line = config.connections[motor.connection].line;
  if (const auto* falcon = std::get_if<FalconConnection>(&line)) {
    return falcon->falcon.unproven_watchdog;
  }
  if (const auto* haply = std::get_if<HaplyConnection>(&line)) {
    return haply->haply.unproven_watchdog;
  }
  return std::visit(
      [](const auto& drive) {
        if constexpr (requires { drive.unproven_watchdog; }) {
          return drive.unproven_watchdog;
        } else {
          return false;
        }
      },
      motor.drive);
}

}  // namespace tactus::firmware
