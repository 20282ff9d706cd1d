#include "hal/can_frame.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>

#include <algorithm>
#include <array>

#include "tests/unit/hal/random.h"

namespace tactus::hal {
namespace {

TEST(CanFrame, SpeaksTheKernelsBits) {
  EXPECT_EQ(CanFilter::kExtended, CAN_EFF_FLAG);
  EXPECT_EQ(CanFilter::kRemote, CAN_RTR_FLAG);
  EXPECT_EQ(kMaxStandardId, CAN_SFF_MASK);
  EXPECT_EQ(kMaxExtendedId, CAN_EFF_MASK);
  EXPECT_EQ(kMaxCanBytes, CAN_MAX_DLEN);
  EXPECT_EQ(kMaxCanFdBytes, CANFD_MAX_DLEN);
  EXPECT_EQ(kCanTransmitTimeout, CAN_ERR_TX_TIMEOUT);
  EXPECT_EQ(kCanLostArbitration, CAN_ERR_LOSTARB);
  EXPECT_EQ(kCanController, CAN_ERR_CRTL);
  EXPECT_EQ(kCanProtocol, CAN_ERR_PROT);
  EXPECT_EQ(kCanTransceiver, CAN_ERR_TRX);
  EXPECT_EQ(kCanNoAcknowledge, CAN_ERR_ACK);
  EXPECT_EQ(kCanBusOff, CAN_ERR_BUSOFF);
  EXPECT_EQ(kCanBusError, CAN_ERR_BUSERROR);
  EXPECT_EQ(kCanRestarted, CAN_ERR_RESTARTED);
  EXPECT_EQ(kCanErrorCounters, CAN_ERR_CNT);
  EXPECT_EQ(kCanReceiveOverflow, CAN_ERR_CRTL_RX_OVERFLOW);
  EXPECT_EQ(kCanTransmitOverflow, CAN_ERR_CRTL_TX_OVERFLOW);
  EXPECT_EQ(kCanReceiveWarning, CAN_ERR_CRTL_RX_WARNING);
  EXPECT_EQ(kCanTransmitWarning, CAN_ERR_CRTL_TX_WARNING);
  EXPECT_EQ(kCanReceivePassive, CAN_ERR_CRTL_RX_PASSIVE);
  EXPECT_EQ(kCanTransmitPassive, CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(kCanBackToActive, CAN_ERR_CRTL_ACTIVE);
}

TEST(CanFrame, IdentifierFitsItsKind) {
  EXPECT_TRUE(is_valid({.id = 0x7FF}));
  EXPECT_FALSE(is_valid({.id = 0x800}));
  EXPECT_TRUE(is_valid({.id = 0x1FFF'FFFF, .extended = true}));
  EXPECT_FALSE(is_valid({.id = 0x2000'0000, .extended = true}));
}

TEST(CanFrame, ClassicFramesEndAtEightBytes) {
  EXPECT_TRUE(is_valid({.length = 8}));
  EXPECT_FALSE(is_valid({.length = 9}));
  EXPECT_FALSE(is_valid({.bit_rate_switch = true}));
  EXPECT_FALSE(is_valid({.error_state_indicator = true}));
}

TEST(CanFrame, FdFramesHaveOnlyTheLengthsACodeExistsFor) {
  const std::array<std::uint8_t, 16> lengths{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  for (int length = 0; length <= 70; ++length) {
    const bool exists = std::ranges::find(lengths, length) != lengths.end();
    EXPECT_EQ(is_valid({.fd = true, .length = static_cast<std::uint8_t>(length)}), exists)
        << length;
    if (length <= 64) {
      EXPECT_EQ(padded_fd_length(static_cast<std::size_t>(length)),
                *std::ranges::lower_bound(lengths, length));
    }
  }
  EXPECT_EQ(padded_fd_length(1000), 64);
}

TEST(CanFrame, FdKnowsNoRemoteRequest) {
  EXPECT_TRUE(is_valid({.remote = true}));
  EXPECT_FALSE(is_valid({.remote = true, .fd = true}));
}

TEST(CanFrame, RemoteRequestHasALengthButNoBytes) {
  EXPECT_EQ(CanFrame({.remote = true, .length = 8}).bytes().size(), 0U);
  EXPECT_EQ(CanFrame({.length = 8}).bytes().size(), 8U);
}

TEST(CanFilter, ExactFilterPassesOneIdentifierOfOneKind) {
  const CanFilter filter = CanFilter::standard(0x123);
  EXPECT_TRUE(passes(filter, {.id = 0x123}));
  EXPECT_FALSE(passes(filter, {.id = 0x122}));
  EXPECT_FALSE(passes(filter, {.id = 0x123, .extended = true}));
  EXPECT_FALSE(passes(filter, {.id = 0x123, .remote = true}));
  EXPECT_TRUE(passes(CanFilter::extended(0x123), {.id = 0x123, .extended = true}));
  EXPECT_FALSE(passes(CanFilter::extended(0x123), {.id = 0x123}));
}

TEST(CanFilter, MaskWithoutTheFlagsPassesEitherKind) {
  const CanFilter filter{.word = 0x100, .mask = 0x700};
  EXPECT_TRUE(passes(filter, {.id = 0x1FF}));
  EXPECT_TRUE(passes(filter, {.id = 0x1555'5100, .extended = true}));
  EXPECT_FALSE(passes(filter, {.id = 0x200}));
}

// The oracle goes through the identifiers bit by bit.
TEST(CanFilter, AgreesWithComparingBitByBit) {
  Random random(1);
  for (int round = 0; round < 20'000; ++round) {
    CanFrame frame{.extended = random.one_in(2), .remote = random.one_in(4)};
    frame.id = random.bits() & (frame.extended ? kMaxExtendedId : kMaxStandardId);
    const CanFilter filter{.word = random.one_in(2) ? filter_word(frame) : random.bits(),
                           .mask = random.bits() & random.bits() & random.bits(),
                           .inverted = random.one_in(3)};
    bool every_bit_agrees = true;
    for (unsigned bit = 0; bit < 32; ++bit) {
      bool value = bit < 29 && ((frame.id >> bit) & 1U) != 0;
      value = bit == 31 ? frame.extended : bit == 30 ? frame.remote : value;
      const bool wanted = ((filter.word >> bit) & 1U) != 0;
      const bool counts = ((filter.mask >> bit) & 1U) != 0;
      every_bit_agrees = every_bit_agrees && (!counts || value == wanted);
    }
    ASSERT_EQ(passes(filter, frame), every_bit_agrees != filter.inverted);
  }
}

}  // namespace
}  // namespace tactus::hal
