// A baked device: a checked view of its sections, and the configuration that they contain.
//
// An image is the 64-byte header of rendering/scene/image_format.h, with its own magic number and
// version, and then the FlatBuffers payload of device.fbs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "firmware/device_file/device_config.h"
#include "firmware/device_file/setting.h"

namespace tactus::firmware {

inline constexpr std::array<char, 8> kDeviceMagic{'T', 'A', 'C', 'D', 'E', 'V', '\r', '\n'};
inline constexpr std::uint32_t kDeviceFormatVersion = 2;
inline constexpr std::size_t kMaxSections = 24;
inline constexpr std::size_t kMaxSettings = 64;  // of one section

// One table of the file. The top level of the file is the section "device".
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

// The reason why an image or its content was refused. Texts live as long as the program, the image
// and the configuration that was read into.
struct DeviceError {
  std::string_view what;
  std::size_t section = 0;  // index into DeviceSections
  std::string_view key;     // empty: it is about the whole section
};

// Checks the header, the checksum and the payload, and that its numbers are finite. Not real time.
// `image` begins at a multiple of rendering::kImageAlignment. The views into it live as long as it
// does.
std::expected<void, DeviceError> open_device_image(std::span<const std::byte> image,
                                                   DeviceSections& sections);

// Reads the sections into a configuration and checks every field against its range. Baking uses it
// with the file's lines at hand, and the controller uses it again. Not real time.
std::expected<void, DeviceError> read_device(const DeviceSections& sections, DeviceConfig& config);

// A key that a section may have, for advice on a wrong key.
struct KnownKey {
  std::string_view key;
  std::string_view unit;
};
// Writes the keys that the section may have to `keys`, as many as fit, and returns their number.
std::size_t known_keys(const DeviceSections& sections, std::size_t section,
                       std::span<KnownKey> keys);

}  // namespace tactus::firmware
