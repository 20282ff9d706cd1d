// The result that `tactus commission` writes into a device's image: whether every joint answered
// its motor correctly, and a checksum of the settings for which that was measured.
//
// Not real time.
#pragma once

#include <cstdint>
#include <expected>

#include "firmware/device_file/device_image.h"

namespace tactus::firmware {

inline constexpr std::string_view kCommissioningKind = "commissioning";

// The keys of the section.
inline constexpr std::string_view kCommissioningPassed = "passed";
inline constexpr std::string_view kCommissioningInertia = "inertia";      // by joint
inline constexpr std::string_view kCommissioningMass = "moving_mass_kg";  // that the answers fit
inline constexpr std::string_view kCommissioningFriction = "friction";
inline constexpr std::string_view kCommissioningDelay = "delay_ticks";
inline constexpr std::string_view kCommissioningMethod = "measured_with";
inline constexpr std::string_view kCommissioningSettings = "settings";  // a checksum

// Returns the result in section `index`. Errors: a key that is missing, unknown or of the wrong
// type.
std::expected<Commissioning, DeviceError> read_commissioning(const DeviceSections& sections,
                                                             std::size_t index);

// Returns the reason why force is refused, with the command that changes that; empty for a device
// that was commissioned with these settings and passed. Texts live as long as the program.
std::string_view commissioning_refusal(const Commissioning& commissioning);

}  // namespace tactus::firmware
