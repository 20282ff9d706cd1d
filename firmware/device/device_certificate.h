// The certificate that `tactus certify` leaves in a device's image: which surfaces the device can
// hold, and for which settings that was measured.
//
// Not real time.
#pragma once

#include <cstdint>
#include <expected>

#include "firmware/device/device_image.h"

namespace tactus::firmware {

inline constexpr std::string_view kCertificateKind = "certificate";

// The keys of the section.
inline constexpr std::string_view kCertificateDampings = "damping_Ns_per_m";
inline constexpr std::string_view kCertificateStiffnesses = "stiffness_N_per_m";
inline constexpr std::string_view kCertificateMargin = "margin";
inline constexpr std::string_view kCertificateMethod = "measured_with";
inline constexpr std::string_view kCertificateSettings = "settings";  // a checksum

// FNV-1a (64 bits) over every setting that the stability of a contact can depend on: all but the
// device's name, what is in the connections, and the certificate itself. The order within a section
// does not matter to it; that of the sections does.
std::uint64_t settings_checksum(const DeviceSections& sections);

// The same over all settings but the device's name and what tools have found out about it: a motor
// on another node or port is another motor.
std::uint64_t all_settings_checksum(const DeviceSections& sections);

// As the file writes it: 16 hexadecimal digits.
struct ChecksumText {
  std::array<char, 16> digits{};
  [[nodiscard]] std::string_view view() const { return {digits.data(), digits.size()}; }
};
ChecksumText checksum_text(std::uint64_t checksum);

// What section `index` certifies. `is_for_these_settings` is false in a certificate that was made
// before something was changed: its points are then left out. Errors: a key that is missing,
// unknown or of the wrong type, lists of different lengths, more than kMaxCertifiedPoints.
std::expected<Certification, DeviceError> read_certificate(const DeviceSections& sections,
                                                           std::size_t index);

}  // namespace tactus::firmware
