#include "firmware/device_file/device_commissioning.h"

#include <algorithm>
#include <array>

#include "firmware/device_file/device_certificate.h"

namespace tactus::firmware {
namespace {

const Setting* setting_of(const DeviceSection& section, std::string_view key) {
  const auto all = section.all();
  const auto found = std::ranges::find(all, key, &Setting::key);
  return found == all.end() ? nullptr : &*found;
}

// Returns an error for the first key that is missing, unknown or of the wrong type.
std::expected<void, DeviceError> check_types(const DeviceSection& section, std::size_t index) {
  using Key = std::pair<std::string_view, SettingType>;
  constexpr std::array<Key, 7> kKeys = {{{kCommissioningPassed, SettingType::flag},
                                         {kCommissioningInertia, SettingType::numbers},
                                         {kCommissioningMass, SettingType::number},
                                         {kCommissioningFriction, SettingType::numbers},
                                         {kCommissioningDelay, SettingType::numbers},
                                         {kCommissioningMethod, SettingType::text},
                                         {kCommissioningSettings, SettingType::text}}};
  for (const auto& [key, type] : kKeys) {
    const Setting* const setting = setting_of(section, key);
    if (setting == nullptr || setting->type != type) {
      return std::unexpected(
          DeviceError{"is missing or of another type; run tactus commission again", index, key});
    }
  }
  for (const Setting& setting : section.all()) {
    if (std::ranges::find(kKeys, setting.key, &Key::first) == kKeys.end()) {
      return std::unexpected(DeviceError{"unknown key", index, setting.key});
    }
  }
  return {};
}

}  // namespace

std::expected<Commissioning, DeviceError> read_commissioning(const DeviceSections& sections,
                                                             std::size_t index) {
  const DeviceSection& section = sections.sections[index];
  if (const auto checked = check_types(section, index); !checked) {
    return std::unexpected(checked.error());
  }
  const auto passed = setting_of(section, kCommissioningPassed)->numbers;
  return Commissioning{
      .is_there = true,
      .is_for_these_settings = setting_of(section, kCommissioningSettings)->text ==
                               checksum_text(all_settings_checksum(sections)).view(),
      .passed = !passed.empty() && passed[0] != 0.0,
      .moving_mass_kg = setting_of(section, kCommissioningMass)->numbers[0],
      .measured_with = setting_of(section, kCommissioningMethod)->text};
}

std::string_view commissioning_refusal(const Commissioning& commissioning) {
  if (!commissioning.is_there) {
    return "this device was not commissioned: nobody has seen its motors and encoders agree; run "
           "tactus commission device.toml and tactus bake device.toml, or start with "
           "--allow-uncommissioned";
  }
  if (!commissioning.is_for_these_settings) {
    return "this device was changed since it was commissioned; run tactus commission device.toml "
           "and tactus bake device.toml again, or start with --allow-uncommissioned";
  }
  if (!commissioning.passed) {
    return "this device failed its commissioning; mend what tactus commission device.toml names, "
           "or start with --allow-uncommissioned";
  }
  return {};
}

}  // namespace tactus::firmware
