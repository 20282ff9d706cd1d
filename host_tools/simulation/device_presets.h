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

// "falcon": Novint Falcon. Lengths and encoder after the fact sheet; moving mass, damping and
// friction are assumptions.
DevicePreset falcon_preset();

std::optional<DevicePreset> device_preset(std::string_view name);

}  // namespace tactus::host
