// Takes the simulated device that a device.toml describes, and the places in its workspace where it
// is pressed against walls. Certify and commission use it.
#pragma once

#include <string>
#include <vector>

#include "firmware/device_file/device_config.h"
#include "host_tools/certify/wall_contact.h"

namespace tactus::host {

// A place of the device at which a wall is touched.
struct ContactPlace {
  // The device and the wall; the hand is set later.
  WallContact contact;
  // The place in words: "a wall across x at the middle".
  std::string where;
};

// The device with all of its places.
struct CertifiedDevice {
  // At least one.
  std::vector<ContactPlace> places;
  // A description of the simulated device, for the certificate.
  std::string measured_with;
};

// Returns the device with these places: the middle of the workspace, and the points at six tenths
// of the way from it to each side, as far as the mechanism reaches them within its joints' limits;
// at each of them a wall across every axis along which the handle can move. Weights and their
// compensation are left out, since both are constant forces. Throws InputError if the mechanism
// reaches nothing within its joints' limits.
CertifiedDevice certified_device(const firmware::DeviceConfig& config);

}  // namespace tactus::host
