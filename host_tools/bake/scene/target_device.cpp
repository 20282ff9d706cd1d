#include "host_tools/bake/scene/target_device.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>

namespace tactus::host {
namespace {

constexpr std::array kDeviceKeys{KeySpec{"mass_kg", "kg"}, KeySpec{"damping_Ns_per_m", "Ns_per_m"},
                                 KeySpec{"rate_hz", "hz"}, KeySpec{"delay_ticks", ""},
                                 KeySpec{"max_normal_force_N", "N"}};

}  // namespace

TargetDevice read_device(const TomlSection& scene, std::string_view file) {
  TargetDevice description;
  const toml::table* table = scene.table("device");
  if (table == nullptr) {
    return description;
  }
  const TomlSection section(*table, file, "[device]", kDeviceKeys);
  rendering::SampledDevice& device = description.device;
  device.mass_kg = section.number("mass_kg", kAboveZero).value_or(device.mass_kg);
  device.damping_Ns_per_m =
      section.number("damping_Ns_per_m", kZeroOrMore).value_or(device.damping_Ns_per_m);
  if (const std::optional<double> rate_Hz = section.number("rate_hz", kAboveZero)) {
    device.step_s = 1.0 / *rate_Hz;
  }
  device.delay_ticks =
      static_cast<int>(section.count("delay_ticks", rendering::kMaxDelayTicks, 0)
                           .value_or(static_cast<std::size_t>(device.delay_ticks)));
  description.max_normal_force_N =
      section.number("max_normal_force_N", kAboveZero).value_or(description.max_normal_force_N);
  return description;
}

std::string in_words(const TargetDevice& description) {
  const rendering::SampledDevice& device = description.device;
  return fmt::format("{} kg, {} N s/m, {:.6g} Hz and a delay of {} tick{}", device.mass_kg,
                     device.damping_Ns_per_m, 1.0 / device.step_s, device.delay_ticks,
                     device.delay_ticks == 1 ? "" : "s");
}

}  // namespace tactus::host
