// The settings of device.toml as drivers bind them, and vectors besides.
#pragma once

#include "drivers/common/setting.h"
#include "rendering/geometry/vector.h"

namespace tactus::drivers {

// It stands beside the other functions `assign`, where `bind` finds it.
inline std::string_view assign(Vec3& field, const Setting& setting) {
  if (setting.type != SettingType::numbers || setting.numbers.size() != 3) {
    return "must be three numbers, [x, y, z]";
  }
  field = {setting.numbers[0], setting.numbers[1], setting.numbers[2]};
  return {};
}

}  // namespace tactus::drivers

namespace tactus::firmware {

using drivers::bind;
using drivers::Binding;
using drivers::Setting;
using drivers::SettingType;
using drivers::Word;

}  // namespace tactus::firmware
