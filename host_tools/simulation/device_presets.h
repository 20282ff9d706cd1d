// The simulated devices that `tactus sim --device` offers by name. The simulation, the certifier
// and the emulators build their plants from them. simulation/README.md has their figures in a
// table, and says which are published and which are assumptions.
#pragma once

#include <optional>
#include <string_view>

#include "host_tools/simulation/simulated_device.h"

namespace tactus::host {

// A device and where its workspace lies.
struct DevicePreset {
  // Its mechanics, encoders, motors and delays.
  DeviceParameters device;
  // The middle of the workspace in the device's base frame, m. The middle of the wish path is put
  // there.
  Vec3 centre_B = Vec3::Zero();
};

// "cartesian": a fast desktop device with three orthogonal linear axes of 0.24 m travel each. It is
// no real device; all of its figures are assumptions.
DevicePreset cartesian_preset();

// "falcon": the Novint Falcon. Lengths, encoders and motors of this and the next devices are
// published; moving mass, damping and friction are assumptions.
DevicePreset falcon_preset();

// "hapkit": the Hapkit, one paddle whose handle moves on an arc of 66 mm radius.
DevicePreset hapkit_preset();

// "haply_pantograph": the Haply development kit, which lies flat: its handle stays in the plane y =
// 0.
DevicePreset haply_pantograph_preset();

// "phantom_premium": the PHANToM Premium 1.5, statically balanced.
DevicePreset phantom_premium_preset();

// "woodenhaptics": WoodenHaptics of 2015, with the weight of its links.
DevicePreset woodenhaptics_preset();

// Returns a preset by its name, one of firmware::kPresetNames; nothing for any other name.
std::optional<DevicePreset> device_preset(std::string_view name);

}  // namespace tactus::host
