// The names of the attachments and metadata keys of a recording. With them a recording can be
// replayed on any machine.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "firmware/linux/telemetry/attachment_list.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::firmware {

// The name of the device image, as it was given to the program. kSceneAttachment is the scene's.
inline constexpr std::string_view kDeviceAttachment = "device.tactus";
// The ControllerConfig written by save_config(), for a run without a device image.
inline constexpr std::string_view kConfigAttachment = "controller.config";
// The bytes of Controller::save() before the first recorded tick, if that is not tick 0.
inline constexpr std::string_view kStateAttachment = "controller.state";

// The checksums in the images' headers, 16 hexadecimal digits.
inline constexpr std::string_view kDeviceChecksumKey = "device.checksum";
inline constexpr std::string_view kSceneChecksumKey = "scene.checksum";
inline constexpr std::string_view kSceneFileKey = "scene.file";

// The number of the recorded device, 1 for the controller's first, and the number of its devices.
// A run of one device has neither.
inline constexpr std::string_view kDeviceNumberKey = "device.number";
inline constexpr std::string_view kDeviceCountKey = "device.count";

// Returns the attachment of an image. An image larger than 64 MiB is left out (empty bytes); the
// recording then has only its file name and checksum.
inline Attachment attachment_of(std::string_view name, std::span<const std::byte> image) {
  constexpr std::size_t kLargest_bytes = std::size_t{64} << 20U;
  return {.name = name,
          .bytes = image.size() <= kLargest_bytes ? image : std::span<const std::byte>{}};
}

}  // namespace tactus::firmware
