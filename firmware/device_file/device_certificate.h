// The certificate that `tactus certify` writes into a device's image: the surfaces that the device
// can render, and a checksum of the settings for which that was measured.
//
// Not real time.
#pragma once

#include <cstdint>
#include <expected>

#include "firmware/device_file/device_image.h"

namespace tactus::firmware {

inline constexpr std::string_view kCertificateKind = "certificate";

// The keys of the section.
inline constexpr std::string_view kCertificateDampings = "damping_Ns_per_m";
inline constexpr std::string_view kCertificateStiffnesses = "stiffness_N_per_m";
inline constexpr std::string_view kCertificateMargin = "margin";
inline constexpr std::string_view kCertificateMethod = "measured_with";
inline constexpr std::string_view kCertificateSettings = "settings";  // a checksum

// Returns the FNV-1a hash (64 bits) over every setting that can affect the stability of a contact.
// It leaves out the device's name, the connections' settings and the certificate itself. It depends
// on the order of the sections, but not on the order within one.
std::uint64_t settings_checksum(const DeviceSections& sections);

// Returns the same hash over all settings except the device's name and the results of tools. It
// includes the connections, since a motor on another node or port is another motor.
std::uint64_t all_settings_checksum(const DeviceSections& sections);

// A checksum as the file has it: 16 hexadecimal digits.
struct ChecksumText {
  std::array<char, 16> digits{};
  [[nodiscard]] std::string_view view() const { return {digits.data(), digits.size()}; }
};
ChecksumText checksum_text(std::uint64_t checksum);

// Returns the certificate in section `index`. `is_for_these_settings` is false if a setting changed
// since; its points are then left out. Errors: a key that is missing, unknown or of the wrong type,
// lists of different lengths, more than kMaxCertifiedPoints.
std::expected<Certification, DeviceError> read_certificate(const DeviceSections& sections,
                                                           std::size_t index);

}  // namespace tactus::firmware
