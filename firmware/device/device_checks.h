// What must hold between the settings of a device, beyond the range of each. Not real time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>

#include "drivers/field_error.h"
#include "firmware/device/device_config.h"
#include "firmware/device/words.h"

namespace tactus::firmware {

drivers::Checked check(const PlantConfig& plant);

// The drive of an axis, on the connection that the axis has in `device`.
drivers::Checked check_drive(const AxisConfig& axis, const DeviceConfig& device);

// The device's own settings and its controller's, once all of it is read.
drivers::Checked check(const DeviceConfig& device);

// The part of a device that a message is about.
enum class Place : std::uint8_t { device, connection, axis, joint };

struct Refusal {
  Place place = Place::device;
  std::size_t index = 0;  // of the connection, axis or joint in DeviceConfig
  std::string_view key;   // empty: the part as a whole
  std::string_view rule;  // a view into `words`, or a literal
};
using Verdict = std::expected<void, Refusal>;

// The device as a whole, by the functions below in this order. `words` holds the message.
Verdict check_whole(const DeviceConfig& device, Words& words);

// sharing_checks.cpp: nothing is used twice, and names are such as the system can have: interfaces,
// ports, chips, pins, motors, encoders, numbers of drives, and identifiers on a CAN bus.
Verdict check_sharing(const DeviceConfig& device, Words& words);

// pin_checks.cpp, called by check_sharing.
Verdict check_pins(const DeviceConfig& device, Words& words);

// rate_checks.cpp: every drive can be as fast as the controller, and every bus can carry it.
Verdict check_rates(const DeviceConfig& device, Words& words);

// reference_checks.cpp: every joint says how it learns where it is, and can learn it that way.
Verdict check_references(const DeviceConfig& device, Words& words);

// Every motor loses its torque when the host dies, or its owner accepts that it may not.
Verdict check_motor_stops(const DeviceConfig& device, Words& words);

}  // namespace tactus::firmware
