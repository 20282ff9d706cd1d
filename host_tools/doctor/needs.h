// The interfaces, permissions and settings that a device needs on its machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/device_file/device_config.h"
#include "firmware/device_file/motor_stop.h"

namespace tactus::host {

struct CanNeed {
  std::string interface;
  bool fd = false;     // a drive on it speaks CAN FD
  std::string set_up;  // what `ip link set can0 up type can` takes for its drives
};

struct GpioNeed {
  std::string chip;  // label or path
  std::string pwm_folder;
  std::string counter;  // empty: none
};

// A motor, and what takes its torque away when the host dies.
struct MotorNeed {
  std::string axis;
  firmware::MotorStop stop = firmware::MotorStop::nothing;
  bool is_accepted = false;  // by unproven_watchdog = true
  drivers::Advice advice;    // on its drive's watchdog
  double watchdog_s = 0.0;   // of a drive
};

struct Needs {
  std::vector<MotorNeed> motors;
  std::vector<CanNeed> can;
  std::vector<GpioNeed> gpio;
  std::vector<std::string> serial_ports;
  bool falcon = false;
  // Whatever is there: no device was named.
  bool anything = false;
};

Needs needs_of(const firmware::DeviceConfig& config);
inline Needs needs_of_any_device() {
  return {.anything = true};
}

}  // namespace tactus::host
