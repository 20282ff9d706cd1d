#include "firmware/device_file/device_image.h"

#include <cmath>
#include <cstring>

#include "firmware/device_file/device_generated.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {

namespace {

using Refused = std::unexpected<DeviceError>;

Refused refuse_image(std::string_view what, std::size_t section = 0, std::string_view key = {}) {
  return Refused(DeviceError{what, section, key});
}

std::string_view view(const flatbuffers::String* text) {
  return text == nullptr ? std::string_view{} : std::string_view(text->c_str(), text->size());
}

std::expected<std::span<const std::byte>, DeviceError> payload_of(
    std::span<const std::byte> image) {
  rendering::ImageHeader header;
  if (reinterpret_cast<std::uintptr_t>(image.data()) % rendering::kImageAlignment != 0) {
    return refuse_image("the image must lie at an address that is a multiple of 16");
  }
  if (image.size() < sizeof(header)) {
    return refuse_image("the file is too short for a device image; bake it again");
  }
  std::memcpy(&header, image.data(), sizeof(header));
  if (header.magic == rendering::kImageMagic) {
    return refuse_image("this is a scene image; give the image of a device");
  }
  if (header.magic != kDeviceMagic) {
    return refuse_image("this is no device image; bake device.toml and give its output");
  }
  if (header.version != kDeviceFormatVersion) {
    return refuse_image("the image is of another version of this program; bake it again");
  }
  const auto payload = image.subspan(sizeof(header));
  if (payload.size() != header.payload_bytes) {
    return refuse_image("the file is cut short or has something after its end; bake it again");
  }
  if (rendering::image_checksum(header, payload) != header.checksum) {
    return refuse_image("the file is damaged: its checksum is wrong; bake it again");
  }
  return payload;
}

// Reads a stored setting. Returns an empty text if it is sound.
std::string_view read_setting(const image::Setting& stored, Setting& setting) {
  setting.key = view(stored.key());
  setting.type = static_cast<SettingType>(stored.type());
  setting.text = view(stored.text());
  if (const auto* numbers = stored.numbers()) {
    // FlatBuffers' verifier only demands the alignment of a vector's length, four bytes. Its
    // builder aligns an empty vector to no more.
    if (numbers->size() > 0 &&
        reinterpret_cast<std::uintptr_t>(numbers->Data()) % alignof(double) != 0) {
      return "is stored at an address that no double may have";
    }
    setting.numbers = {numbers->data(), numbers->size()};
  }
  for (const double number : setting.numbers) {
    if (!std::isfinite(number)) {
      return "must be finite";
    }
  }
  switch (setting.type) {
    case SettingType::number:
    case SettingType::flag:
      return setting.numbers.size() == 1 ? "" : "has no value";
    case SettingType::numbers:
    case SettingType::text:
      return "";
  }
  return "has a value of an unknown type";
}

}  // namespace

std::expected<void, DeviceError> open_device_image(std::span<const std::byte> image,
                                                   DeviceSections& sections) {
  sections.count = 0;
  const auto payload = payload_of(image);
  if (!payload) {
    return Refused(payload.error());
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(payload->data());
  flatbuffers::Verifier verifier(bytes, payload->size());
  if (!image::VerifyDeviceBuffer(verifier)) {
    return refuse_image("the image is malformed; bake it again");
  }
  const auto& stored = *image::GetDevice(bytes)->sections();
  if (stored.size() > kMaxSections) {
    return refuse_image("too many sections");
  }
  for (const image::Section* section : stored) {
    DeviceSection& out = sections.sections[sections.count];
    out = {};
    out.kind = view(section->kind());
    if (section->settings()->size() > kMaxSettings) {
      return refuse_image("too many settings", sections.count);
    }
    for (const image::Setting* setting : *section->settings()) {
      const auto wrong = read_setting(*setting, out.settings[out.setting_count]);
      if (!wrong.empty()) {
        return refuse_image(wrong, sections.count, out.settings[out.setting_count].key);
      }
      ++out.setting_count;
    }
    ++sections.count;
  }
  return {};
}

}  // namespace tactus::firmware
