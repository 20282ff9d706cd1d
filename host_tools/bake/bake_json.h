// Bakes a file of either kind, and reports it as JSON. `tactus bake --json` and the Python module
// use it.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/bake/scene/bake.h"

namespace tactus::host {

// Bakes the device `file` into `image`. Throws InputError; the file's certificate is an input too,
// and is not overwritten.
LoadedDevice bake_device_file(const std::filesystem::path& file,
                              const std::filesystem::path& image);

// Return a report as one line of JSON.
std::string bake_json(const BakeReport& report);
std::string bake_json(const LoadedDevice& device, const std::filesystem::path& image);

}  // namespace tactus::host
