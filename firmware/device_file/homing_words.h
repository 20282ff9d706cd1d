// The words that tell the user what to do while a device finds its reference. Not for a tick.
#pragma once

#include "drivers/common/words.h"
#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Adds to `words`, joint by joint, what homing asks of the user: "hold 'left' still at 180 deg, let
// 'right' move by itself". Angles are in degrees, lengths in mm. Adds nothing if it asks nothing.
void add_homing_words(const DeviceConfig& config, Words& words);

}  // namespace tactus::firmware
