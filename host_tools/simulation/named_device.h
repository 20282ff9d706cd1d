// The simulated device that a user names: a preset, or the file of an own device.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drivers/composition/transmission.h"
#include "firmware/configuration/controller_config.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {

// A device and the controller that goes with it.
struct NamedDevice {
  DevicePreset device;
  firmware::ControllerConfig controller;
  // The conversions between joints and shafts, one for each joint; empty for a preset.
  std::vector<drivers::Transmission> transmissions;

  // Returns true if a file describes it.
  [[nodiscard]] bool is_described() const { return !transmissions.empty(); }
};

// Returns true for a name with an extension: the path of a file, not the name of a preset.
bool names_file(std::string_view name);

// Returns the device of one of firmware::kPresetNames, or of a device image (.tactus) or device
// file
// (.toml, which is baked in memory). Throws InputError that names the option if there is none.
NamedDevice named_device(const std::string& name, std::string_view option);

}  // namespace tactus::host
