// Compares the packets with those recorded from Novint's own software and with facts read in
// libnifalcon, not with our own coder.
#include "drivers/falcon_usb/packet.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::drivers {
namespace {

FalconPacket packet_of(std::string_view text) {
  FalconPacket packet{};
  EXPECT_EQ(text.size(), packet.size());
  for (std::size_t i = 0; i < packet.size(); ++i) {
    packet[i] = static_cast<std::byte>(text[i]);
  }
  return packet;
}

std::string packet_text(const FalconPacket& packet) {
  std::string text;
  for (const std::byte byte : packet) {
    text.push_back(std::to_integer<char>(byte));
  }
  return text;
}

struct Recorded {
  std::string_view packet;
  std::array<std::int16_t, kFalconArms> motor;
};

// Host to device, LED blue, as Novint's library sent them for a force given to it.
constexpr std::array<Recorded, 8> kRecorded = {{
    {"<FJCALNCAOPCAEA>", {661, 731, 766}},
    {"<PBFANKFAGPFAEA>", {1311, 1453, 1526}},
    {"<AMKAMNKAIELAEA>", {2752, 2780, 2888}},
    {"<PPPACEPACMPAEA>", {4095, 3906, 4034}},
    {"<JFNPBOJAKLIPEA>", {-679, 2529, -1862}},
    {"<BLJADGNPFGJPEA>", {2481, -669, -1691}},
    {"<MKEPLBAABKDAEA>", {-2900, 27, 929}},
    {"<PIBABPDPPGEAEA>", {399, -3087, 1135}},
}};

TEST(FalconPacket, IsWhatNovintsSoftwareSendsForTheSameMotorValues) {
  for (const Recorded& recorded : kRecorded) {
    const FalconCommand command{.motor = recorded.motor, .lights = {.blue = true}, .homing = false};
    EXPECT_EQ(packet_text(encode(command)), recorded.packet);
  }
}

TEST(FalconPacket, ReadsTheRecordedNumbers) {
  for (const Recorded& recorded : kRecorded) {
    const auto reply = decode_falcon_reply(packet_of(recorded.packet));
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->counts, recorded.motor);
  }
}

TEST(FalconPacket, ReadsTheNumberOfTheProtocolsDescription) {
  const auto reply = decode_falcon_reply(packet_of("<JFKPAAAAAAAAAA>"));
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->counts[0], -1447);
}

TEST(FalconPacket, EachFlagHasItsBit) {
  EXPECT_EQ(packet_text(encode({.homing = false})), "<AAAAAAAAAAAAAA>");
  EXPECT_EQ(packet_text(encode({})), "<AAAAAAAAAAAABA>");
  EXPECT_EQ(packet_text(encode({.lights = {.green = true}, .homing = false})), "<AAAAAAAAAAAACA>");
  EXPECT_EQ(packet_text(encode({.lights = {.blue = true}, .homing = false})), "<AAAAAAAAAAAAEA>");
  EXPECT_EQ(packet_text(encode({.lights = {.red = true}, .homing = false})), "<AAAAAAAAAAAAIA>");
}

TEST(FalconPacket, MotorsAreClampedToWhatTheDeviceTakes) {
  const FalconCommand command{.motor = {32'767, -32'768, 4'096}};
  const auto sent = decode_falcon_reply(encode(command));
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->counts, (std::array<std::int16_t, 3>{4095, -4095, 4095}));
}

TEST(FalconPacket, ButtonsAndHomedBitsMayGoBeyondTheLetterP) {
  const auto reply =
      decode_falcon_reply(packet_of("<AAAAAAAAAAAA\xB6"
                                    "A>"));  // 'A' + 0x75
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->buttons, kFalconButtonRight | kFalconButtonCentre);
  EXPECT_EQ(reply->homed, 0b111);
  EXPECT_TRUE(reply->all_homed());
}

TEST(FalconPacket, WrongFrameLetterOrFlagIsRefused) {
  EXPECT_FALSE(decode_falcon_reply(packet_of("<AAAAAAAAAAAAAA<")));
  EXPECT_FALSE(decode_falcon_reply(packet_of(">AAAAAAAAAAAAAA>")));
  EXPECT_FALSE(decode_falcon_reply(packet_of("<AAAQAAAAAAAAAA>")));
  EXPECT_FALSE(decode_falcon_reply(packet_of("<AAA@AAAAAAAAAA>")));
  EXPECT_FALSE(decode_falcon_reply(packet_of("<AAAAAAAAAAAA@A>")));
  EXPECT_FALSE(
      decode_falcon_reply(packet_of("<AAAAAAAAAAAA\xC1"
                                    "A>")));
}

TEST(FalconPacket, EveryMotorValueComesBackAsItWent) {
  for (int value = -kFalconMotorLimit; value <= kFalconMotorLimit; ++value) {
    const auto motor = static_cast<std::int16_t>(value);
    const auto sent = decode_falcon_reply(encode({.motor = {motor, 0, motor}}));
    ASSERT_TRUE(sent);
    ASSERT_EQ(sent->counts, (std::array<std::int16_t, 3>{motor, 0, motor}));
  }
}

TEST(FalconPacket, OneCountIsTheDegreesOfTheFactSheet) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  EXPECT_NEAR(kFalconRadPerCount * kDegrees, 0.0364347, 1e-7);
  EXPECT_NEAR((kFalconZeroRad - 1000 * kFalconRadPerCount) * kDegrees, -1.434659, 1e-6);
  EXPECT_NEAR((kFalconZeroRad - 500 * kFalconRadPerCount) * kDegrees, 16.78267, 1e-5);
}

TEST(FalconPacketReader, FindsPacketsInPiecesAndBetweenRubbish) {
  FalconPacketReader reader;
  std::vector<std::int16_t> found;
  const std::string_view stream =
      "AAA><<JFKPAAAAAAAAAA>xx<FJCALNCA<FJCALNCAOPCAEA><AAAAAAAAAAAAA<AAAAAAAAAAAAAA>";
  for (const char letter : stream) {
    if (const auto reply = reader.take(static_cast<std::byte>(letter))) {
      found.push_back(reply->counts[0]);
    }
  }
  EXPECT_EQ(found, (std::vector<std::int16_t>{-1447, 661, 0}));
  EXPECT_EQ(reader.skipped(), 5U + 2U + 9U + 14U);
}

TEST(FalconPacketReader, FindsAPacketAfterAnyRubbish) {
  constexpr unsigned kSeed = 20260;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> count(0, 40);
  for (int trial = 0; trial < 2000; ++trial) {
    FalconPacketReader reader;
    for (int i = count(random); i > 0; --i) {
      reader.take(static_cast<std::byte>(byte(random)));
    }
    // At worst the rubbish opened a packet that swallows the first of two.
    bool found = false;
    for (const char letter : std::string("<JFKPAAAAAAAAAA><JFKPAAAAAAAAAA>")) {
      const auto reply = reader.take(static_cast<std::byte>(letter));
      found = found || (reply && reply->counts[0] == -1447);
    }
    ASSERT_TRUE(found);
  }
}

TEST(FtdiPayload, LiesBehindTwoBytesOfStatus) {
  const std::array<std::byte, 5> packet = {std::byte{0x31}, std::byte{0x60}, std::byte{1},
                                           std::byte{2}, std::byte{3}};
  EXPECT_EQ(ftdi_payload(packet).size(), 3U);
  EXPECT_EQ(ftdi_payload(packet).front(), std::byte{1});
  EXPECT_TRUE(ftdi_payload(std::span(packet).first(2)).empty());
  EXPECT_TRUE(ftdi_payload(std::span(packet).first(1)).empty());
  EXPECT_TRUE(ftdi_payload({}).empty());
}

}  // namespace
}  // namespace tactus::drivers
