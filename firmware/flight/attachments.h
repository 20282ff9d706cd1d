// What a recording holds beside its ticks and the images, so that it can be replayed anywhere: the
// names of its attachments, and the keys of what it notes of the run.
#pragma once

#include <string_view>

namespace tactus::firmware {

// ControllerConfig, by save_config(): of a run without a device image.
inline constexpr std::string_view kConfigAttachment = "controller.config";
// Controller::save() before the first tick, of a recording that does not begin with tick 0.
inline constexpr std::string_view kStateAttachment = "controller.state";

// The checksums in the images' headers, 16 hexadecimal digits.
inline constexpr std::string_view kDeviceChecksumKey = "device.checksum";
inline constexpr std::string_view kSceneChecksumKey = "scene.checksum";

}  // namespace tactus::firmware
