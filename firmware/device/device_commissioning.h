// The result that `tactus commission` leaves in a device's image: whether every joint answered its
// motor as it should, and for which settings that was found.
//
// Not real time.
#pragma once

#include <cstdint>
#include <expected>

#include "firmware/device/device_image.h"

namespace tactus::firmware {

inline constexpr std::string_view kCommissioningKind = "commissioning";

// The keys of the section.
inline constexpr std::string_view kCommissioningPassed = "passed";
inline constexpr std::string_view kCommissioningInertia = "inertia";      // by joint
inline constexpr std::string_view kCommissioningMass = "moving_mass_kg";  // that it agreed with
inline constexpr std::string_view kCommissioningFriction = "friction";
inline constexpr std::string_view kCommissioningDelay = "delay_ticks";
inline constexpr std::string_view kCommissioningMethod = "measured_with";
inline constexpr std::string_view kCommissioningSettings = "settings";  // a checksum

// What section `index` says. Errors: a key that is missing, unknown or of the wrong type.
std::expected<Commissioning, DeviceError> read_commissioning(const DeviceSections& sections,
                                                             std::size_t index);

// Why force is refused, and the command that mends it; empty for a device that was commissioned
// with these settings and passed. Texts live as long as the program.
std::string_view commissioning_refusal(const Commissioning& commissioning);

}  // namespace tactus::firmware
