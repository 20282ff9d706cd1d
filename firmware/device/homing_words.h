// What the user does while a device finds its reference, in words. Not for a tick.
#pragma once

#include <span>
#include <string_view>

#include "firmware/device/device_config.h"

namespace tactus::firmware {

// Joint by joint, what homing asks of the user: "hold 'left' still at 180 deg, let 'right'
// move by itself". Angles are in degrees, lengths in mm. Empty if it asks nothing. Written
// into `room`, cut at its end.
std::string_view homing_words(const DeviceConfig& config, std::span<char> room);

}  // namespace tactus::firmware
