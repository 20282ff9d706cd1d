// The simulated device that a device file describes: the preset that its [mechanism] names, with
// the file's own lengths, weights, limits and [plant]. The simulation, the certifier, the
// commission and the emulators build their plants from it.
#pragma once

#include <optional>

#include "firmware/device_file/device_config.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {

// Returns the device. A file that has a preset's own lengths and limits has its workspace, too; all
// others have the one that find_workspace() finds. Without [plant] moving_mass_kg the mass at the
// handle is that of the mechanism's weights, or the preset's if the file changes none. All joints
// have the coarsest encoder and the strongest motor of the file. Throws InputError if the mechanism
// reaches nothing within its joints' limits.
DevicePreset described_device(const firmware::DeviceConfig& config);

// Returns the size of a count of the joint's encoder, rad or m, as the settings of its driver have
// it; nothing if only the drive knows it.
std::optional<double> encoder_count_of(const firmware::DeviceConfig& config,
                                       const firmware::JointConfig& joint);

}  // namespace tactus::host
