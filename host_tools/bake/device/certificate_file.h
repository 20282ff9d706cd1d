// The certificate of a device, beside its device.toml: `tactus certify` writes it, and baking puts
// it into the image.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/device_file/device_image.h"

namespace tactus::host {

// "arm.certificate.toml" beside "arm.toml".
std::filesystem::path certificate_path(const std::filesystem::path& device);

// "arm.commissioning.toml" beside "arm.toml", which tactus commission writes.
std::filesystem::path commissioning_path(const std::filesystem::path& device);

// Throws InputError if it cannot be written. `settings_checksum` is firmware::settings_checksum of
// the device that was measured.
void write_certificate(const std::filesystem::path& file,
                       const firmware::StiffnessCertificate& certificate,
                       const std::string& measured_with, std::uint64_t settings_checksum);

}  // namespace tactus::host
