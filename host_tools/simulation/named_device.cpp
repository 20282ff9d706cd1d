#include "host_tools/simulation/named_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <optional>
#include <span>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/simulation/described_device.h"

namespace tactus::host {
namespace {

NamedDevice device_of_file(const std::string& file) {
  const LoadedDevice loaded = load_device(file);
  const firmware::DeviceConfig& config = loaded.config();
  NamedDevice named{.device = {}, .controller = config.controller, .transmissions = {}};
  try {
    named.device = described_device(config);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
  for (const firmware::JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    named.transmissions.push_back(joint.transmission);
  }
  return named;
}

}  // namespace

bool names_file(std::string_view name) {
  return std::filesystem::path(name).has_extension();
}

NamedDevice named_device(const std::string& name, std::string_view option) {
  if (names_file(name)) {
    return device_of_file(name);
  }
  const std::optional<DevicePreset> device = device_preset(name);
  const std::optional<firmware::ControllerConfig> controller = firmware::preset_config(name);
  if (!device || !controller) {
    throw InputError(fmt::format(
        "{}: there is no '{}'; there are {}, and the file of an own device: arm.toml or arm.tactus",
        option, name, fmt::join(firmware::kPresetNames, ", ")));
  }
  return {.device = *device, .controller = *controller, .transmissions = {}};
}

}  // namespace tactus::host
