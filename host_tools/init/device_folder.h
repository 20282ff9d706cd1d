// The folder of a new device: device.toml, scene.toml and README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/init/device_plan.h"

namespace tactus::host {

// Throws InputError if one of the three files is in the folder.
void refuse_taken_folder(const std::filesystem::path& folder);

// Writes the files into the folder, which is made if there is none, and returns their paths. They
// have been baked before they are written. Throws InputError if one is there already, cannot be
// written, or the plan gives a device that baking refuses.
std::vector<std::filesystem::path> write_device_folder(const DevicePlan& plan,
                                                       const std::filesystem::path& folder);

}  // namespace tactus::host
