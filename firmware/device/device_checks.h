// What must hold between the settings of a device, beyond the range of each. Not real time.
#pragma once

#include "drivers/field_error.h"
#include "firmware/device/device_config.h"

namespace tactus::firmware {

drivers::Checked check(const PlantConfig& plant);

// The drive of an axis, on the connection that the axis has in `device`.
drivers::Checked check_drive(const AxisConfig& axis, const DeviceConfig& device);

// The device as a whole, once all of it is read.
drivers::Checked check(const DeviceConfig& device);

}  // namespace tactus::firmware
