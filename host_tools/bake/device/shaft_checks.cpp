#include "host_tools/bake/device/shaft_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tactus::host {
namespace {

// Returns the setting of that key; null if the section has none.
const WrittenSetting* find_setting(const WrittenSection& section, std::string_view key) {
  const auto found = std::ranges::find(section.settings, key, &WrittenSetting::key);
  return found == section.settings.end() ? nullptr : &*found;
}

// Returns true if motor and encoder of the joint are one drive.
bool is_one_drive(const WrittenSection& joint) {
  const WrittenSetting* const motor = find_setting(joint, "motor");
  const WrittenSetting* const encoder = find_setting(joint, "encoder");
  return encoder == nullptr || (motor != nullptr && motor->text == encoder->text);
}

// Returns the number of a setting, 1 if there is none.
double number_of(const WrittenSetting* setting) {
  return setting == nullptr || setting->numbers.empty() ? 1.0 : setting->numbers.front();
}

// Throws InputError if `given` is written and differs from 1, and `missing` is not written.
void refuse_half(const WrittenSection& joint, std::string_view given, std::string_view missing) {
  const WrittenSetting* const setting = find_setting(joint, given);
  if (setting == nullptr || find_setting(joint, missing) != nullptr || number_of(setting) == 1.0) {
    return;
  }
  fail_at(
      joint.file, setting->line,
      fmt::format("{0}: {1} is {2}, and {3} is left at 1, though motor and encoder are one drive; "
                  "write {3} = {2} if they are on one shaft, {3} = 1 if not",
                  joint.title, given, number_of(setting), missing));
}

// Returns the warning about two written settings that differ; empty if they agree.
std::string warn_of_difference(const WrittenSection& joint, std::string_view motor_key,
                               std::string_view encoder_key) {
  const WrittenSetting* const motor = find_setting(joint, motor_key);
  const WrittenSetting* const encoder = find_setting(joint, encoder_key);
  if (motor == nullptr || encoder == nullptr || number_of(motor) == number_of(encoder)) {
    return {};
  }
  return fmt::format(
      "{}:{}: {}: {} is {} and {} is {}, though motor and encoder are one drive: right only if "
      "they "
      "are not on one shaft; tactus commission checks it",
      joint.file, encoder->line, joint.title, motor_key, number_of(motor), encoder_key,
      number_of(encoder));
}

}  // namespace

std::vector<std::string> check_shafts(std::span<const WrittenSection> written) {
  std::vector<std::string> warnings;
  for (const WrittenSection& section : written) {
    if (section.kind != "joint" || !is_one_drive(section)) {
      continue;
    }
    refuse_half(section, "motor_ratio", "encoder_ratio");
    refuse_half(section, "encoder_ratio", "motor_ratio");
    for (const std::string_view kind : {"ratio", "direction"}) {
      std::string warning = warn_of_difference(section, fmt::format("motor_{}", kind),
                                               fmt::format("encoder_{}", kind));
      if (!warning.empty()) {
        warnings.push_back(std::move(warning));
      }
    }
  }
  return warnings;
}

}  // namespace tactus::host
