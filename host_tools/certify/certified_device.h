// The simulated device that stands for a device.toml: the preset of its mechanism, what its [plant]
// says, and where in its workspace it is to be pressed against walls.
#pragma once

#include <string>
#include <vector>

#include "firmware/device_file/device_config.h"
#include "host_tools/certify/wall_contact.h"

namespace tactus::host {

// A place of the device at which walls are touched. The hand in `contact` is not set.
struct ContactPlace {
  WallContact contact;
  std::string where;  // "wall across x at the middle"
};

struct CertifiedDevice {
  std::vector<ContactPlace> places;  // at least one
  std::string measured_with;         // what was simulated, for the certificate
};

// The middle of the workspace and the points at six tenths of the way from it to each side, as far
// as the mechanism reaches them within its joints' limits, with walls across every axis along which
// the handle can move there. Weights are left out, and with them their compensation: both are
// constant. Throws InputError if the mechanism's lengths are not those of any simulated device.
CertifiedDevice certified_device(const firmware::DeviceConfig& config);

}  // namespace tactus::host
