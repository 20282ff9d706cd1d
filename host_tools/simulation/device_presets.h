// The simulated devices that `tactus sim` offers by name.
#pragma once

#include <optional>
#include <string_view>

#include "host_tools/simulation/simulated_device.h"

namespace tactus::host {

struct DevicePreset {
  DeviceParameters device;
  Vec3 centre_B = Vec3::Zero();  // m: the middle of the workspace; the scene's origin is put there
};

// "cartesian": a fast desktop device with three orthogonal linear axes, 0.24 m of travel each.
DevicePreset cartesian_preset();

// Lengths, encoders and motors of the devices below are published; moving mass, damping and
// friction are assumptions.

// "falcon": Novint Falcon.
DevicePreset falcon_preset();

// "hapkit": one paddle, its handle on an arc of 66 mm radius.
DevicePreset hapkit_preset();

// "haply_pantograph": the Haply development kit, flat on the desk, the handle in the plane y = 0.
DevicePreset haply_pantograph_preset();

// "phantom_premium": PHANToM Premium 1.5, statically balanced.
DevicePreset phantom_premium_preset();

// "woodenhaptics": WoodenHaptics of 2015, with the weight of its links.
DevicePreset woodenhaptics_preset();

// Returns a preset by its name in firmware::kPresetNames; nothing for another name.
std::optional<DevicePreset> device_preset(std::string_view name);

}  // namespace tactus::host
