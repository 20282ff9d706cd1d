// Checks that the settings of a device fit together; the range of each is checked elsewhere. Not
// real time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>

#include "drivers/common/field_error.h"
#include "drivers/common/words.h"
#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Checks every field against its range.
drivers::Checked check(const PlantConfig& plant);

// Checks the drive of an axis, on the connection that the axis has in `device`.
drivers::Checked check_drive(const AxisConfig& axis, const DeviceConfig& device);

// Checks the device's own settings and its controller's, once all of it is read.
drivers::Checked check(const DeviceConfig& device);

// The part of a device that a message is about.
enum class Place : std::uint8_t { device, connection, axis, joint };

// The reason why a device is refused.
struct Refusal {
  Place place = Place::device;
  std::size_t index = 0;  // of the connection, axis or joint in DeviceConfig
  std::string_view key;   // empty: it is about the whole part
  std::string_view rule;  // a view into `words`, or a literal
};
using Verdict = std::expected<void, Refusal>;

// Checks the device as a whole by the functions below, in this order. `words` holds the message.
Verdict check_whole(const DeviceConfig& device, Words& words);

// Checks that nothing is used twice and that names are valid for the system: interfaces, ports,
// chips, pins, motors, encoders, numbers of drives, and identifiers on a CAN bus. In
// sharing_checks.cpp.
Verdict check_sharing(const DeviceConfig& device, Words& words);

// Checks two drives on one CAN bus: they must not answer to the same number, nor have a common
// identifier of their frames. `index` is that of `axis`; `of_other` follows the other's name in the
// message. In sharing_checks.cpp.
Verdict check_can_pair(const AxisConfig& axis, std::size_t index, const AxisConfig& other,
                       std::string_view of_other, Words& words);

// Checks the pins. It is called by check_sharing. In pin_checks.cpp.
Verdict check_pins(const DeviceConfig& device, Words& words);

// Checks that every drive can be as fast as the controller, and that every bus can carry it. In
// rate_checks.cpp.
Verdict check_rates(const DeviceConfig& device, Words& words);

// Checks that every joint has a reference, and one that its encoder allows. In
// reference_checks.cpp.
Verdict check_references(const DeviceConfig& device, Words& words);

// Checks that every motor loses its torque when the host dies, or that its owner accepts that it
// may not.
Verdict check_motor_stops(const DeviceConfig& device, Words& words);

}  // namespace tactus::firmware
