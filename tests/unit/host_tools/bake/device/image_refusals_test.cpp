// Images that are refused: made by hand, or by another version.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "rendering/scene/image_format.h"
#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

// An image made by hand, or by another version, is held to the same.
TEST_F(DeviceRefusals, AnImageIsHeldToTheSameAsAFile) {
  const auto file = folder.write("device.toml", paddle("", kKnownPose));
  std::vector<std::byte> image = bake_device(file).image();
  const std::string pose = "known_pose";
  const auto at = std::ranges::search(image, pose, [](std::byte b, char c) {
                    return static_cast<char>(b) == c;
                  }).begin();
  ASSERT_NE(at, image.end());
  // The text's length stands before it.
  std::memcpy(&*at, "absolute\0\0", pose.size());
  *(at - 4) = std::byte{8};
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), sizeof(header));
  header.checksum = rendering::image_checksum(header, std::span(image).subspan(sizeof(header)));
  std::memcpy(image.data(), &header, sizeof(header));
  try {
    (void)LoadedDevice(image, "image");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).contains("reference does not fit")) << error.what();
  }
}

TEST_F(DeviceRefusals, AnImageOfTheVersionBeforeMustBeBakedAgain) {
  const auto file = folder.write("device.toml", paddle("", kKnownPose));
  std::vector<std::byte> image = bake_device(file).image();
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), sizeof(header));
  header.version = 1;
  header.checksum =
      rendering::image_checksum(header, std::span<const std::byte>(image).subspan(sizeof(header)));
  std::memcpy(image.data(), &header, sizeof(header));
  try {
    (void)LoadedDevice(image, "image");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).contains("bake it again")) << error.what();
  }
}

}  // namespace
}  // namespace tactus::host
