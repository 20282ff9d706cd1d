// One tactusd per run folder, CAN interface, serial port and PWM channel. Pins and USB devices the
// kernel gives to one program alone. What another program holds is told on stderr, with its
// process.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "firmware/device/device_config.h"
#include "hal/linux/exclusive_claim.h"

namespace tactus::firmware {

// Held until the end of the program. Before anything is opened.
class ExclusiveUse {
 public:
  // False: told.
  bool of_run_folder(const char* folder);
  // What is not there is left to its own opening, which says so; the same.
  bool of_boards(const DeviceConfig& config);

 private:
  bool take(std::string_view name, std::string_view what, std::string_view which);

  std::array<hal::ExclusiveClaim, kMaxConnections + 1> claims_;
  std::size_t taken_ = 0;
};

}  // namespace tactus::firmware
