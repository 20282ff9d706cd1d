// The keys that each section of device.toml may have, and the fields behind them. A key for a new
// field is one line in device_settings.cpp or joint_settings.cpp; a driver's is in its folder, and
// a mechanism's in its file in firmware/kinematics.
#pragma once

#include <span>

#include "firmware/device_file/device_config.h"
#include "firmware/device_file/setting.h"

namespace tactus::firmware {

// The two settings that decide which other keys a section may have: the kind of a connection or a
// mechanism, and the driver of an axis.
inline constexpr std::string_view kKindKey = "kind";
inline constexpr std::string_view kDriverKey = "driver";

std::span<const Binding<DeviceConfig>> device_keys();
std::span<const Binding<ControllerConfig>> controller_keys();
// The keys of the plant, with the units of a joint that turns or slides.
std::span<const Binding<PlantConfig>> turning_plant_keys();
std::span<const Binding<PlantConfig>> sliding_plant_keys();
std::span<const Binding<ConnectionConfig>> connection_keys();
std::span<const Binding<AxisConfig>> axis_keys();
// The keys of a joint. One that turns is in rad and N m, one that slides in m and N.
std::span<const Binding<JointConfig>> turning_joint_keys();
std::span<const Binding<JointConfig>> sliding_joint_keys();

}  // namespace tactus::firmware
