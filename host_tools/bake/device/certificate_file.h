// The certificate of a device, beside its device.toml: `tactus certify` writes it, and baking puts
// it into the image.
#pragma once

#include <filesystem>
#include <string>

#include "firmware/device_file/device_image.h"

namespace tactus::host {

// Returns the certificate's path: "arm.certificate.toml" beside "arm.toml".
std::filesystem::path certificate_path(const std::filesystem::path& device);

// Returns the path of the file that tactus commission writes: "arm.commissioning.toml" beside
// "arm.toml".
std::filesystem::path commissioning_path(const std::filesystem::path& device);

// Writes the certificate. `settings_checksum` is firmware::settings_checksum of the device that was
// measured. Throws InputError if the file cannot be written.
void write_certificate(const std::filesystem::path& file,
                       const firmware::StiffnessCertificate& certificate,
                       const std::string& measured_with, std::uint64_t settings_checksum);

}  // namespace tactus::host
