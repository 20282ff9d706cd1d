// Compares the protocol with the worked examples of the fact sheet, byte for byte.
#include "drivers/haply_serial/protocol.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/unit/drivers/transcript.h"

namespace tactus::drivers {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<std::byte> bytes_of(const HaplyMessage& message) {
  return {message.bytes().begin(), message.bytes().end()};
}

TEST(HaplyProtocol, SetupOfThePantographIsTheWorkedExample) {
  const std::array<HaplyAxisSetup, 2> axes = {{{.angle_now_rad = kPi}, {.angle_now_rad = 0.0}}};
  EXPECT_EQ(
      bytes_of(haply_setup(5, axes)),
      hex_bytes("01 05 03 00 00 03 00 00 00 00 00 00 34 43 00 00 58 46 00 00 00 00 00 00 58 46"));
}

TEST(HaplyProtocol, TorquesAreTheWorkedExample) {
  EXPECT_EQ(bytes_of(haply_torques(5, std::array{0.01, -0.02})),
            hex_bytes("02 05 0A D7 23 3C 0A D7 A3 BC"));
}

TEST(HaplyProtocol, AnswerIsTheWorkedExample) {
  const auto angles = decode_haply_reply(hex_bytes("05 00 00 16 43 00 00 F0 41"), 5, 2);
  ASSERT_TRUE(angles);
  EXPECT_NEAR((*angles)[0], 150.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR((*angles)[1], 30.0 * kPi / 180.0, 1e-12);
}

TEST(HaplyProtocol, ResetIsTwoBytes) {
  EXPECT_EQ(bytes_of(haply_reset(3)), hex_bytes("00 03"));
}

TEST(HaplyProtocol, DirectionsFollowTheirMasks) {
  const std::array<HaplyAxisSetup, 2> axes = {
      {{.motor_counter_clockwise = true}, {.encoder_counter_clockwise = true}}};
  const auto setup = bytes_of(haply_setup(5, axes));
  EXPECT_EQ(std::vector(setup.begin(), setup.begin() + 10),
            hex_bytes("01 05 03 01 00 03 00 01 00 00"));
}

TEST(HaplyProtocol, EveryMessageOfFourAxesFitsOnePacket) {
  const std::array<HaplyAxisSetup, 4> axes;
  EXPECT_EQ(haply_setup(5, axes).bytes().size(), 46U);
  EXPECT_EQ(haply_torques(5, std::array{0.0, 0.0, 0.0, 0.0}).bytes().size(), 18U);
}

TEST(HaplyProtocol, TorqueNeverExceedsTheBoardsLimitAlsoAsAFloat) {
  for (const double torque : {0.123, 1.0, 1e300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    for (const double sign : {1.0, -1.0}) {
      const auto message = bytes_of(haply_torques(5, std::array{sign * torque}));
      ASSERT_EQ(message.size(), 6U);
      const auto sent =
          std::bit_cast<float>(std::array{message[2], message[3], message[4], message[5]});
      EXPECT_LE(std::abs(static_cast<double>(sent)), kHaplyTorqueLimit_Nm);
      EXPECT_TRUE(!std::isfinite(torque) ? sent == 0.0F : std::abs(sent) > 0.1229F);
    }
  }
}

TEST(HaplyProtocol, AnswerOfAnotherDeviceOrOfNoAngleIsRefused) {
  EXPECT_FALSE(decode_haply_reply(hex_bytes("04 00 00 16 43 00 00 F0 41"), 5, 2));
  EXPECT_FALSE(decode_haply_reply(hex_bytes("05 00 00 16 43 00 00 F0"), 5, 2));
  EXPECT_FALSE(decode_haply_reply(hex_bytes("05 00 00 C0 7F 00 00 F0 41"), 5, 2));  // NaN
  EXPECT_FALSE(decode_haply_reply(hex_bytes("05 00 00 80 7F 00 00 F0 41"), 5, 2));  // infinity
  EXPECT_FALSE(decode_haply_reply(hex_bytes("05 00 00 16 43 00 24 74 49"), 5, 2));  // 1e6 degrees
  EXPECT_FALSE(decode_haply_reply({}, 5, 2));
}

}  // namespace
}  // namespace tactus::drivers
