// A baked device: the checked view of its sections, and the configuration that they mean.
//
// An image is the 64-byte header of rendering/scene/image_format.h, with a magic number and a
// version of its own, then the FlatBuffers payload of device.fbs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "firmware/device/device_config.h"
#include "firmware/device/setting.h"

namespace tactus::firmware {

inline constexpr std::array<char, 8> kDeviceMagic{'T', 'A', 'C', 'D', 'E', 'V', '\r', '\n'};
inline constexpr std::uint32_t kDeviceFormatVersion = 2;
inline constexpr std::size_t kMaxSections = 24;
inline constexpr std::size_t kMaxSettings = 64;  // of one section

// One table of the file. The top of the file is the section "device".
struct DeviceSection {
  std::string_view kind;
  std::array<Setting, kMaxSettings> settings{};
  std::size_t setting_count = 0;

  [[nodiscard]] std::span<const Setting> all() const { return {settings.data(), setting_count}; }
};

struct DeviceSections {
  std::array<DeviceSection, kMaxSections> sections{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const DeviceSection> all() const { return {sections.data(), count}; }
};

// Why an image or its content was refused. Texts live as long as the program, the image and the
// configuration that was read into.
struct DeviceError {
  std::string_view what;
  std::size_t section = 0;  // index into DeviceSections
  std::string_view key;     // empty: the section as a whole
};

// Checks the header, the checksum and the payload, and that its numbers are finite; not real time.
// `image` begins at a multiple of rendering::kImageAlignment; the views into it live as long as it.
std::expected<void, DeviceError> open_device_image(std::span<const std::byte> image,
                                                   DeviceSections& sections);

// What the sections mean, every field checked against its range. Used by baking, with the file's
// lines at hand, and again by the controller. Not real time.
std::expected<void, DeviceError> read_device(const DeviceSections& sections, DeviceConfig& config);

// The keys that this section may have, for advice on one that it may not: as many as fit.
struct KnownKey {
  std::string_view key;
  std::string_view unit;
};
std::size_t known_keys(const DeviceSections& sections, std::size_t section,
                       std::span<KnownKey> keys);

}  // namespace tactus::firmware
