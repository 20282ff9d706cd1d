// What a device needs of the machine it hangs on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/device/device_config.h"

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

struct Needs {
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
