// Makes the image that the controller reads at its start from device.toml, whose keys are listed in
// host_tools/bake/README.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/device_file/device_image.h"

namespace tactus::host {

// An image in memory with what it means; the configuration's texts are views into the image.
class LoadedDevice {
 public:
  // Throws InputError if the controller would refuse the image.
  LoadedDevice(std::vector<std::byte> image, const std::string& name);

  [[nodiscard]] const firmware::DeviceConfig& config() const { return *config_; }
  [[nodiscard]] const std::vector<std::byte>& image() const { return image_; }
  // Returns the checksum of the settings that the stability of a contact depends on, for the
  // certificate.
  [[nodiscard]] std::uint64_t settings_checksum() const { return settings_checksum_; }
  // Returns the checksum of all settings but the device's name and the results of tools, for the
  // commissioning.
  [[nodiscard]] std::uint64_t all_settings_checksum() const { return all_settings_checksum_; }
  // Returns baking's warnings for the user, one line each.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }

 private:
  std::vector<std::byte> image_;
  std::unique_ptr<firmware::DeviceConfig> config_;
  std::uint64_t settings_checksum_ = 0;
  std::uint64_t all_settings_checksum_ = 0;
  std::vector<std::string> warnings_;
};

// Returns true if the file describes a device, that is, has a mechanism, and false for a scene.
// Throws InputError if it cannot be read or is no TOML.
bool describes_device(const std::filesystem::path& file);

// Checks everything. Takes in what tactus certify and tactus commission left beside the file
// (certificate_file.h), if it is there and the settings are still those it was made for; a warning
// if not. Throws InputError naming file, line and remedy.
LoadedDevice bake_device(const std::filesystem::path& file);

// Returns the device of a file: bake_device() of a device.toml, or the content of an image
// (.tactus). Throws InputError if it is neither.
LoadedDevice load_device(const std::filesystem::path& file);

// Returns a summary for the user, such as "3 joints on 1 connection: ...".
std::string in_words(const firmware::DeviceConfig& config);

}  // namespace tactus::host
