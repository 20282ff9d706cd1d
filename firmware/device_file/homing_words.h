// Explains to the user in words how to home a device. Not for a tick.
#pragma once

#include <span>
#include <string_view>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Returns the instructions joint by joint: "hold 'left' still at 180 deg, let 'right' move by
// itself". Angles are in degrees, lengths in mm. Empty if homing needs no action. The text is
// written into `room` and cut at its end.
std::string_view homing_words(const DeviceConfig& config, std::span<char> room);

}  // namespace tactus::firmware
