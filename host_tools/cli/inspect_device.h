// `tactus inspect arm.tactus`: what is in a device file or image, and what the device can do.
#pragma once

#include <string>

namespace tactus::host {

// What the user asked for.
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
