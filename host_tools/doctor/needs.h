// The interfaces, permissions and settings that a device needs on its machine, taken from its
// configuration. The checks of the doctor compare them with the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/device_file/device_config.h"
#include "firmware/device_file/motor_stop.h"

namespace tactus::host {

// A CAN interface of the device.
struct CanNeed {
  // Its name, such as "can0".
  std::string interface;
  // True if a drive on it speaks CAN FD.
  bool fd = false;
  // The words that follow `ip link set can0 up type can` for the drives on it.
  std::string set_up;
  // The bit rates that the device's file gives, bit/s; 0 if there is no device, or no CAN FD.
  std::int64_t bitrate = 0;
  std::int64_t data_bitrate = 0;
  // The share of the bus' time that the frames of the device's drives take; 0 without a device.
  double load = 0.0;
};

// The pins of a motor that the board drives itself.
struct GpioNeed {
  // The GPIO chip's label or path.
  std::string chip;
  // The PWM chip's folder in /sys/class/pwm.
  std::string pwm_folder;
  // The quadrature counter's name in /sys/bus/counter/devices; empty if there is none.
  std::string counter;
};

// A motor, and the means that takes its torque away when the host dies.
struct MotorNeed {
  // The name of the motor's axis in the device's file.
  std::string axis;
  firmware::MotorStop stop = firmware::MotorStop::nothing;
  // True if the owner accepts the risk by unproven_watchdog = true.
  bool is_accepted = false;
  // Advice on the watchdog of the drive.
  drivers::Advice advice;
  // The timeout of the drive's own watchdog; 0 if it has none.
  double watchdog_s = 0.0;
};

// All needs of one device.
struct Needs {
  // The ticks per second, and the instructions that the rendering of a tick may take.
  double rate_hz = firmware::ControllerConfig{}.rate_hz;
  double tick_instructions = firmware::tick_instructions({});
  std::vector<MotorNeed> motors;
  std::vector<CanNeed> can;
  std::vector<GpioNeed> gpio;
  // Paths such as "/dev/ttyACM0".
  std::vector<std::string> serial_ports;
  // True if the device is a Novint Falcon on USB.
  bool falcon = false;
  // True if no device was named: the checks then look at whatever is plugged in.
  bool anything = false;
};

// Returns the needs of a device. A motor is listed once for each joint that it drives.
Needs needs_of(const firmware::DeviceConfig& config);
// Returns the needs for an examination without a device.
inline Needs needs_of_any_device() {
  return {.anything = true};
}

}  // namespace tactus::host
