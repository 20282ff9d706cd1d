// `tactus inspect arm.tactus`: prints the content of a device file or image, and the abilities of
// the device.
#pragma once

#include <string>

namespace tactus::host {

// The wishes of the user.
struct InspectDeviceOptions {
  // A device.toml or its image.
  std::string device;
  // A scene image whose reach is checked; empty: none.
  std::string scene;
  // The picture of the reach; empty: none.
  std::string picture;
  bool json = false;
};

// Returns true if the file is a device.toml or a device image, by its content.
bool is_device_file(const std::string& file);

// Prints the device as text or JSON, and draws its reach. Throws InputError if a file cannot be
// used or the picture cannot be written.
void inspect_device(const InspectDeviceOptions& options);

}  // namespace tactus::host
