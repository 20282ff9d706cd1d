// Ratios and directions of one shaft that do not go together.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

TEST_F(DeviceRefusals, ARatioOfAShaftThatIsLeftOutIsRefusedWithItsLine) {
  const std::string joint_keys = std::string(kKnownPose) + "motor_ratio = 16\n";
  expect_words(paddle("", joint_keys),
               {"motor_ratio is 16, and encoder_ratio is left at 1", "write encoder_ratio = 16",
                "encoder_ratio = 1 if not", "[[joint]]"});
  expect_words(paddle("", std::string(kKnownPose) + "encoder_ratio = 12\n"),
               {"encoder_ratio is 12, and motor_ratio is left at 1", "write motor_ratio = 12"});
  expect_bakes(paddle("", joint_keys + "encoder_ratio = 16\n"));
  // The owner has said that the encoder is at the joint.
  expect_bakes(paddle("", joint_keys + "encoder_ratio = 1\n"));
  expect_bakes(paddle("", std::string(kKnownPose) + "motor_ratio = 1\n"));
}

TEST_F(DeviceRefusals, AnEncoderOfItsOwnNeedsNoRatioBesideTheMotors) {
  expect_bakes(device("hapkit", 500.0) + kBus + odrive("motor", 0) + odrive("at the joint", 1) +
               joint("paddle", "motor",
                     std::string(kKnownPose) + "encoder = \"at the joint\"\nmotor_ratio = 16\n"));
}

TEST_F(DeviceRefusals, DifferentRatiosAndDirectionsOfAShaftAreWarnedOf) {
  const auto warnings_of = [&](const std::string& keys) {
    return bake_device(folder.write("device.toml", paddle("", kKnownPose + keys))).warnings();
  };
  const auto tells = [](const std::vector<std::string>& warnings, std::string_view words) {
    return std::ranges::any_of(warnings,
                               [&](const std::string& text) { return text.contains(words); });
  };
  EXPECT_TRUE(tells(warnings_of("motor_ratio = 16\nencoder_ratio = 15\n"),
                    "motor_ratio is 16 and encoder_ratio is 15"));
  EXPECT_TRUE(tells(warnings_of("motor_direction = 1\nencoder_direction = -1\n"),
                    "motor_direction is 1 and encoder_direction is -1"));
  EXPECT_FALSE(tells(warnings_of("motor_ratio = 16\nencoder_ratio = 16\n"), "motor_ratio"));
}

}  // namespace
}  // namespace tactus::host
