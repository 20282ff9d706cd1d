// The device loader on any bytes: it refuses them, or the configuration that it gives is one that
// the controller takes. The header is made right for three inputs in four.
#include <algorithm>
#include <cstring>
#include <vector>

#include "firmware/device_file/device_image.h"
#include "rendering/scene/image_format.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

std::vector<std::byte> make_image(std::span<const std::byte> input) {
  const auto rest = input.subspan(1);
  if ((static_cast<unsigned>(input[0]) & 3U) == 0) {
    return {rest.begin(), rest.end()};
  }
  rendering::ImageHeader header{.magic = firmware::kDeviceMagic,
                                .version = firmware::kDeviceFormatVersion,
                                .payload_bytes = rest.size()};
  header.checksum = rendering::image_checksum(header, rest);
  std::vector<std::byte> image(sizeof(header) + rest.size());
  std::memcpy(image.data(), &header, sizeof(header));
  std::ranges::copy(rest, image.begin() + sizeof(header));
  return image;
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tactus::firmware;
  if (size == 0) {
    return 0;
  }
  const auto image = tactus::make_image(std::as_bytes(std::span(data, size)));
  static DeviceSections sections;
  static DeviceConfig config;
  if (open_device_image(image, sections) && read_device(sections, config)) {
    tactus::fuzz::require(validate(config.controller).has_value(),
                          "the controller takes what a device image says");
    tactus::fuzz::require(config.joint_count == joint_count(config.controller.mechanism),
                          "as many joints as the mechanism has");
  }
  return 0;
}
