#include "drivers/moteus_canfd/moteus_protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "drivers/moteus_canfd/moteus_errors.h"
#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::moteus {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Reply reply_of(std::string_view hex) {
  const std::vector<std::byte> bytes = bytes_of(hex);
  return read_reply(bytes);
}

TEST(MoteusProtocol, IdentifiersAreThoseOfTheManual) {
  EXPECT_EQ(command_id({.servo = 1, .host = 0}, true), 0x8001U);
  EXPECT_EQ(command_id({.servo = 1, .host = 0}, false), 0x0001U);
  EXPECT_EQ(reply_id({.servo = 1, .host = 0}), 0x0100U);
  EXPECT_EQ(command_id({.servo = 5, .host = 2, .prefix = 0x123}, true), 0x1238205U);
  EXPECT_EQ(reply_id({.servo = 5, .host = 2, .prefix = 0x123}), 0x1230502U);
}

// docs/protocol/can.md of moteus.
TEST(MoteusProtocol, ReadsThePublishedReplyInInt16) {
  const Reply reply = reply_of("24 04 00 0a 00 50 00 00 01 70 ff 23 0d 18 14 00");
  EXPECT_EQ(reply.mode, 10);
  EXPECT_NEAR(reply.position_rad.value(), 0.0080 * kTurn, 1e-12);
  EXPECT_NEAR(reply.velocity_rad_per_s.value(), 0.064 * kTurn, 1e-12);
  EXPECT_NEAR(reply.torque_Nm.value(), -1.44, 1e-12);
  EXPECT_NEAR(reply.voltage_V.value(), 12.0, 1e-12);
  EXPECT_NEAR(reply.temperature_C.value(), 20.0, 1e-12);
  EXPECT_EQ(reply.fault, 0);
  EXPECT_FALSE(reply.refused_register);
}

// A case of moteus's own tests.
TEST(MoteusProtocol, ReadsTheReplyOfTheVendorsTests) {
  const Reply reply = reply_of("24 04 00 0a 00 10 02 00 fe 20 00 23 0d 20 30 40");
  EXPECT_EQ(reply.mode, 10);
  EXPECT_NEAR(reply.position_rad.value(), 0.0528 * kTurn, 1e-12);
  EXPECT_NEAR(reply.velocity_rad_per_s.value(), -0.128 * kTurn, 1e-12);
  EXPECT_NEAR(reply.torque_Nm.value(), 0.32, 1e-12);
  EXPECT_NEAR(reply.voltage_V.value(), 16.0, 1e-12);
  EXPECT_NEAR(reply.temperature_C.value(), 48.0, 1e-12);
  EXPECT_EQ(reply.fault, 64);
}

// Decoded with the project's own Python parser: 0.25 N m, watchdog 20 ms, gains zero, and a query.
TEST(MoteusProtocol, SendsTheTorqueFrameByteForByte) {
  EXPECT_EQ(text_of(torque({}, 0.25F, 0.02F, true)),
            "00008001##1"
            "01000A"
            "0F200000C07F000000000000803E"
            "0E230000000000000000"
            "0D270AD7A33C"
            "0D2B00000000"
            "11001F0110040C"
            "5050");
}

TEST(MoteusProtocol, ReadsTheMatchingReplyInFloats) {
  const Reply reply = reply_of("2100 0a 2f01 0000003f 000000be 0000803e 230d 30 1f 00 50 50");
  EXPECT_EQ(reply.mode, 10);
  EXPECT_NEAR(reply.position_rad.value(), 0.5 * kTurn, 1e-12);
  EXPECT_NEAR(reply.velocity_rad_per_s.value(), -0.125 * kTurn, 1e-12);
  EXPECT_NEAR(reply.torque_Nm.value(), 0.25, 1e-12);
  EXPECT_NEAR(reply.voltage_V.value(), 24.0, 1e-12);
  EXPECT_NEAR(reply.temperature_C.value(), 31.0, 1e-12);
  EXPECT_EQ(reply.fault, 0);
}

TEST(MoteusProtocol, StopFrameIsTheModeAloneOrWithTheQuery) {
  EXPECT_EQ(text_of(stop({.servo = 2}, false)), "002##1010000");
  EXPECT_EQ(text_of(stop({.servo = 2}, true)), "00008002##101000011001F0110040C5050");
  EXPECT_EQ(text_of(query({.servo = 2, .bit_rate_switch = false})), "00008002##011001F0110040C");
}

// A varuint may take more bytes than it needs, and counts may stand in one.
TEST(MoteusProtocol, ReadsCountsAndRegistersOfAnyVaruintLength) {
  EXPECT_EQ(reply_of("21 80 00 0b").mode, 11);
  EXPECT_EQ(reply_of("20 81 00 00 0b").mode, 11);
  EXPECT_EQ(reply_of("20 02 0e 15 22").fault, 0x22);
  EXPECT_EQ(reply_of("21 80 80 80 80 80 00 0b").mode, std::nullopt);  // longer than 5 bytes
}

TEST(MoteusProtocol, ReadsEveryType) {
  EXPECT_NEAR(reply_of("21 01 9c").position_rad.value(), -1.0 * kTurn, 1e-12);
  EXPECT_NEAR(reply_of("25 01 f0d8").position_rad.value(), -1.0 * kTurn, 1e-12);
  EXPECT_NEAR(reply_of("29 01 6079feff").position_rad.value(), -1.0 * kTurn, 1e-12);
  EXPECT_NEAR(reply_of("2d 01 000080bf").position_rad.value(), -1.0 * kTurn, 1e-12);
  EXPECT_EQ(reply_of("2d 00 00003041").mode, 11);
}

TEST(MoteusProtocol, MostNegativeIntegerIsNoNumber) {
  EXPECT_TRUE(std::isnan(reply_of("21 01 80").position_rad.value()));
  EXPECT_TRUE(std::isnan(reply_of("25 01 0080").position_rad.value()));
  EXPECT_TRUE(std::isnan(reply_of("29 01 00000080").position_rad.value()));
  EXPECT_TRUE(std::isnan(reply_of("2d 01 0000c07f").position_rad.value()));
  EXPECT_FALSE(std::isnan(reply_of("21 01 81").position_rad.value()));
}

TEST(MoteusProtocol, ModeOrFaultThatIsNoByteIsNoneThatExists) {
  EXPECT_EQ(reply_of("21 00 80").mode, 255);
  EXPECT_EQ(reply_of("25 00 0010").mode, 255);
  EXPECT_EQ(reply_of("2d 0f 0000c07f").fault, 255);
}

TEST(MoteusProtocol, ScalesAreThoseOfTheRegisterTable) {
  const auto expect = [](Quantity quantity, double int8, double int16, double int32) {
    EXPECT_DOUBLE_EQ(scaled(100, ValueType::int8, quantity), 100 * int8);
    EXPECT_DOUBLE_EQ(scaled(-1000, ValueType::int16, quantity), -1000 * int16);
    EXPECT_DOUBLE_EQ(scaled(100'000, ValueType::int32, quantity), 100'000 * int32);
    if (quantity != Quantity::plain) {
      EXPECT_TRUE(std::isnan(scaled(-128, ValueType::int8, quantity)));
      EXPECT_TRUE(std::isnan(scaled(-32768, ValueType::int16, quantity)));
      EXPECT_TRUE(
          std::isnan(scaled(std::numeric_limits<std::int32_t>::min(), ValueType::int32, quantity)));
    }
  };
  expect(Quantity::plain, 1, 1, 1);
  expect(Quantity::position_rev, 0.01, 0.0001, 0.00001);
  expect(Quantity::velocity_rev_per_s, 0.1, 0.00025, 0.00001);
  expect(Quantity::torque_Nm, 0.5, 0.01, 0.001);
  expect(Quantity::current_A, 1, 0.1, 0.001);
  expect(Quantity::voltage_V, 0.5, 0.1, 0.001);
  expect(Quantity::temperature_C, 1, 0.1, 0.001);
  expect(Quantity::time_s, 0.01, 0.001, 1e-6);
  expect(Quantity::scale, 1.0 / 127, 1.0 / 32767, 1.0 / 2147483647);
}

TEST(MoteusProtocol, RefusalsAreTold) {
  EXPECT_EQ(reply_of("30 2b 01 21 00 0a").refused_register, 0x2BU);
  EXPECT_EQ(reply_of("30 2b 01 21 00 0a").mode, 10);
  EXPECT_EQ(reply_of("31 82 02 01").refused_register, 0x102U);
}

TEST(MoteusProtocol, WhatMakesNoSenseEndsTheReading) {
  EXPECT_EQ(reply_of("21 00 0a 60 21 0f 21").fault, std::nullopt);
  EXPECT_EQ(reply_of("21 00 0a 60 21 0f 21").mode, 10);
  EXPECT_EQ(reply_of("2f 01 0000803f 0000").velocity_rad_per_s, std::nullopt);
  EXPECT_EQ(reply_of("2f 01 0000803f 0000").position_rad, kTurn);
  EXPECT_EQ(reply_of("20 ff ff ff ff 0f 00 0a").mode, 10);
  EXPECT_EQ(reply_of("20 ff ff ff ff 0f ff ff ff ff 0f 0a").mode, std::nullopt);
  EXPECT_FALSE(reply_of("").mode);
  EXPECT_EQ(reply_of("50 50 21 00 0a").mode, 10);
}

TEST(MoteusProtocol, EveryFrameItSendsIsWellFormed) {
  for (std::uint8_t servo = 1; servo <= kMaxServo; ++servo) {
    for (const bool asks : {true, false}) {
      const Address address{.servo = servo, .host = 127, .prefix = kMaxPrefix};
      EXPECT_TRUE(hal::is_valid(stop(address, asks)));
      EXPECT_TRUE(hal::is_valid(torque(address, 1.0F, 0.02F, asks)));
      EXPECT_TRUE(hal::is_valid(query(address)));
    }
  }
}

TEST(MoteusErrors, EveryFaultHasWordsAndEveryLimitIsNone) {
  std::set<std::string_view> seen;
  for (std::uint8_t code = 32; code <= 50; ++code) {
    const Trouble trouble = fault_trouble(code);
    EXPECT_TRUE(seen.insert(trouble.what).second) << int{code};
    EXPECT_EQ(trouble.what.find("this program"), std::string_view::npos) << int{code};
    EXPECT_FALSE(trouble.remedy.empty());
    EXPECT_EQ(trouble.code, code);
    EXPECT_FALSE(is_limit(code));
  }
  for (std::uint8_t code = 96; code <= 103; ++code) {
    EXPECT_TRUE(is_limit(code));
  }
  EXPECT_FALSE(is_limit(95));
  EXPECT_FALSE(is_limit(104));
  EXPECT_NE(fault_trouble(51).what.find("this program"), std::string_view::npos);
}

}  // namespace
}  // namespace tactus::drivers::moteus
