// Finds the firmware that a board is given at its start.
#pragma once

#include <string_view>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Returns the path of the file, or an empty text if no board of the device has one.
std::string_view board_firmware_file(const DeviceConfig& config);

}  // namespace tactus::firmware
