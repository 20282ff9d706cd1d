// What a recording holds beside its ticks, so that it can be replayed anywhere: the names of its
// attachments, and the keys of what it notes of the run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "firmware/telemetry/outputs/attachment_list.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {

// Images as they were given to the program.
inline constexpr std::string_view kDeviceAttachment = "device.tactus";
inline constexpr std::string_view kSceneAttachment = "scene.tactus";
// ControllerConfig, by save_config(): of a run without a device image.
inline constexpr std::string_view kConfigAttachment = "controller.config";
// Controller::save() before the first tick, of a recording that does not begin with tick 0.
inline constexpr std::string_view kStateAttachment = "controller.state";

// The checksums in the images' headers, 16 hexadecimal digits.
inline constexpr std::string_view kDeviceChecksumKey = "device.checksum";
inline constexpr std::string_view kSceneChecksumKey = "scene.checksum";
inline constexpr std::string_view kSceneFileKey = "scene.file";

inline std::uint64_t checksum_of(std::span<const std::byte> image) {
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), std::min(sizeof(header), image.size()));
  return header.checksum;
}

// A larger image is not put into recordings; its file and checksum are.
inline Attachment attachment_of(std::string_view name, std::span<const std::byte> image) {
  constexpr std::size_t kLargest_bytes = std::size_t{64} << 20U;
  return {.name = name,
          .bytes = image.size() <= kLargest_bytes ? image : std::span<const std::byte>{}};
}

}  // namespace tactus::firmware
