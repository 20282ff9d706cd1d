// The contract of every UsbEndpoint. A rig has a device that sends every bulk-out back by bulk-in,
// keeps the value of the vendor request kStore and gives it back (two bytes, lowest first) on
// kFetch, and stalls every other request:
//   UsbEndpoint& endpoint(), Clock& clock()
//   void unplug(), void plug_in()
//   void set_stopped(bool)   the device is there but answers nothing
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "hal/usb_endpoint.h"

namespace tactus::hal {

inline constexpr UsbSetup kStore{.request_type = 0x40, .request = 1};
inline constexpr UsbSetup kFetch{.request_type = 0xC0, .request = 2};
inline constexpr UsbSetup kUnknownRequest{.request_type = 0x40, .request = 99};

struct Read {
  std::array<std::byte, 64> buffer{};
  UsbTransfer transfer = UsbTransfer::in(buffer);
};

template <class Rig>
class UsbEndpointContract : public ::testing::Test {
 protected:
  static constexpr TimeNs kPatience = 200'000'000;

  UsbEndpoint& endpoint() { return rig_.endpoint(); }
  TimeNs soon() { return rig_.clock().now_ns() + kPatience; }

  static std::vector<std::byte> bytes(std::size_t count, unsigned first = 0) {
    std::vector<std::byte> all(count);
    std::ranges::generate(all, [&first] { return static_cast<std::byte>(first++); });
    return all;
  }

  template <class T>
  void expect_refused(const Result<T>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }

  Rig rig_;
};

TYPED_TEST_SUITE_P(UsbEndpointContract);

TYPED_TEST_P(UsbEndpointContract, EchoesWhatWasSent) {
  std::array<std::byte, 64> buffer;
  for (const std::size_t size : {1U, 16U, 63U}) {
    const auto sent = this->bytes(size, 7);
    ASSERT_EQ(this->endpoint().bulk_out(sent, this->soon()), size);
    ASSERT_EQ(this->endpoint().bulk_in(buffer, this->soon()), size);
    EXPECT_TRUE(std::ranges::equal(std::span(buffer).first(size), sent));
  }
}

TYPED_TEST_P(UsbEndpointContract, ShortPacketEndsALongRead) {
  const std::size_t packet = this->endpoint().max_packet_bytes();
  std::vector<std::byte> buffer(4 * packet);
  const auto sent = this->bytes(packet + 5);
  ASSERT_EQ(this->endpoint().bulk_out(sent, this->soon()), sent.size());
  ASSERT_EQ(this->endpoint().bulk_in(buffer, this->soon()), sent.size());
  EXPECT_TRUE(std::ranges::equal(std::span(buffer).first(sent.size()), sent));
}

TYPED_TEST_P(UsbEndpointContract, ReadThatIsNeverEndedGivesWhatCameByTheDeadline) {
  const std::size_t packet = this->endpoint().max_packet_bytes();
  std::vector<std::byte> buffer(4 * packet);
  ASSERT_EQ(this->endpoint().bulk_out(this->bytes(packet), this->soon()), packet);
  const TimeNs deadline_ns = this->soon();
  const auto read = this->endpoint().bulk_in(buffer, deadline_ns);
  // A device may end its answer with an empty packet; then the read is over before the deadline.
  EXPECT_EQ(read, packet);
}

TYPED_TEST_P(UsbEndpointContract, SilenceLastsUntilTheDeadline) {
  std::array<std::byte, 64> buffer;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 5'000'000;
  this->expect_refused(this->endpoint().bulk_in(buffer, deadline_ns), ErrorCode::timeout);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
  this->expect_refused(this->endpoint().bulk_in(buffer, kNoWait), ErrorCode::timeout);
}

TYPED_TEST_P(UsbEndpointContract, EmptyReadIsRefused) {
  this->expect_refused(this->endpoint().bulk_in({}, this->soon()), ErrorCode::invalid_argument);
}

TYPED_TEST_P(UsbEndpointContract, PacketLongerThanTheRoomOverflows) {
  ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(16), this->soon()));
  std::array<std::byte, 4> buffer;
  this->expect_refused(this->endpoint().bulk_in(buffer, this->soon()), ErrorCode::overflow);
}

TYPED_TEST_P(UsbEndpointContract, ControlRequestsReachTheDevice) {
  UsbSetup store = kStore;
  store.value = 0xBEEF;
  ASSERT_EQ(this->endpoint().control_out(store, {}, this->soon()), 0U);
  std::array<std::byte, 2> answer;
  ASSERT_EQ(this->endpoint().control_in(kFetch, answer, this->soon()), 2U);
  EXPECT_EQ(answer[0], std::byte{0xEF});
  EXPECT_EQ(answer[1], std::byte{0xBE});
}

TYPED_TEST_P(UsbEndpointContract, UnknownRequestStallsOnceAndDoesNoHarm) {
  this->expect_refused(this->endpoint().control_out(kUnknownRequest, {}, this->soon()),
                       ErrorCode::stalled);
  EXPECT_TRUE(this->endpoint().control_out(kStore, {}, this->soon()));
}

TYPED_TEST_P(UsbEndpointContract, SetupThatContradictsTheCallIsRefused) {
  std::vector<std::byte> buffer(kMaxUsbControlBytes + 1);
  this->expect_refused(this->endpoint().control_out(kFetch, {}, this->soon()),
                       ErrorCode::invalid_argument);
  this->expect_refused(
      this->endpoint().control_in(kStore, std::span(buffer).first(2), this->soon()),
      ErrorCode::invalid_argument);
  this->expect_refused(this->endpoint().control_in(kFetch, buffer, this->soon()),
                       ErrorCode::invalid_argument);
}

TYPED_TEST_P(UsbEndpointContract, ReadInFlightIsDoneWhenTheAnswerComes) {
  std::array<std::byte, 64> buffer;
  UsbTransfer read = UsbTransfer::in(buffer);
  ASSERT_TRUE(this->endpoint().submit(read));
  EXPECT_EQ(read.state(), UsbTransfer::State::in_flight);
  this->expect_refused(read.result(), ErrorCode::invalid_state);
  this->expect_refused(this->endpoint().wait(read, kNoWait), ErrorCode::timeout);
  ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(16), this->soon()));
  EXPECT_EQ(this->endpoint().wait(read, this->soon()), 16U);
  EXPECT_EQ(read.state(), UsbTransfer::State::done);
  EXPECT_EQ(this->endpoint().wait(read, kNoWait), 16U);
}

TYPED_TEST_P(UsbEndpointContract, TransfersOfOneDirectionKeepTheirOrder) {
  std::array<Read, 4> reads;
  for (Read& read : reads) {
    ASSERT_TRUE(this->endpoint().submit(read.transfer));
  }
  for (unsigned i = 0; i < reads.size(); ++i) {
    ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(8 + i, i), this->soon()));
  }
  for (unsigned i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(this->endpoint().wait(reads[i].transfer, this->soon()), 8U + i);
    EXPECT_EQ(reads[i].buffer[0], std::byte(i));
  }
}

TYPED_TEST_P(UsbEndpointContract, DoneTransferCanFlyAgain) {
  auto data = this->bytes(10);
  UsbTransfer write = UsbTransfer::out(data);
  std::array<std::byte, 64> buffer;
  UsbTransfer read = UsbTransfer::in(buffer);
  for (int i = 0; i < 3; ++i) {
    data.back() = std::byte(100 + i);
    ASSERT_TRUE(this->endpoint().submit(read));
    ASSERT_TRUE(this->endpoint().submit(write));
    EXPECT_EQ(this->endpoint().wait(write, this->soon()), 10U);
    EXPECT_EQ(this->endpoint().wait(read, this->soon()), 10U);
    EXPECT_TRUE(std::ranges::equal(std::span(buffer).first(10), data));
  }
}

TYPED_TEST_P(UsbEndpointContract, CancelledTransferIsDoneAndItsAnswerGoesToTheNext) {
  std::array<std::byte, 64> buffer;
  UsbTransfer read = UsbTransfer::in(buffer);
  this->endpoint().cancel(read);
  EXPECT_EQ(read.state(), UsbTransfer::State::idle);
  ASSERT_TRUE(this->endpoint().submit(read));
  this->endpoint().cancel(read);
  ASSERT_EQ(read.state(), UsbTransfer::State::done);
  this->expect_refused(read.result(), ErrorCode::cancelled);
  this->expect_refused(this->endpoint().wait(read, this->soon()), ErrorCode::cancelled);
  ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(16), this->soon()));
  EXPECT_EQ(this->endpoint().bulk_in(buffer, this->soon()), 16U);
}

TYPED_TEST_P(UsbEndpointContract, OnlySoManyFlyAtOnce) {
  std::array<Read, kMaxUsbTransfersInFlight> reads;
  Read one_more;
  for (Read& read : reads) {
    ASSERT_TRUE(this->endpoint().submit(read.transfer));
  }
  this->expect_refused(this->endpoint().submit(one_more.transfer), ErrorCode::queue_full);
  this->expect_refused(this->endpoint().submit(reads[0].transfer), ErrorCode::invalid_state);
  this->endpoint().cancel(reads[0].transfer);
  EXPECT_TRUE(this->endpoint().submit(one_more.transfer));
  this->endpoint().cancel(one_more.transfer);
  for (Read& read : reads) {
    this->endpoint().cancel(read.transfer);
  }
}

TYPED_TEST_P(UsbEndpointContract, WaitingForWhatWasNeverSubmittedIsRefused) {
  std::array<std::byte, 64> buffer;
  UsbTransfer read = UsbTransfer::in(buffer);
  this->expect_refused(this->endpoint().wait(read, this->soon()), ErrorCode::invalid_state);
}

TYPED_TEST_P(UsbEndpointContract, StoppedDeviceTimesOutAndIsWellAgain) {
  this->rig_.set_stopped(true);
  std::array<std::byte, 64> buffer;
  this->expect_refused(this->endpoint().bulk_in(buffer, this->soon()), ErrorCode::timeout);
  EXPECT_EQ(this->endpoint().state(), UsbState::attached);
  this->rig_.set_stopped(false);
  ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(16), this->soon()));
  EXPECT_EQ(this->endpoint().bulk_in(buffer, this->soon()), 16U);
}

TYPED_TEST_P(UsbEndpointContract, UnplugEndsWhatIsInFlightAndIsSeenAsDetached) {
  std::array<std::byte, 64> buffer;
  UsbTransfer read = UsbTransfer::in(buffer);
  ASSERT_TRUE(this->endpoint().submit(read));
  this->rig_.unplug();
  const auto result = this->endpoint().wait(read, this->soon());
  ASSERT_FALSE(result);
  EXPECT_TRUE(result.error().code == ErrorCode::io ||
              result.error().code == ErrorCode::disconnected);
  this->rig_.clock().sleep_until(this->soon());
  EXPECT_EQ(this->endpoint().state(), UsbState::detached);
  this->expect_refused(this->endpoint().bulk_out(this->bytes(1), this->soon()),
                       ErrorCode::disconnected);
  this->expect_refused(this->endpoint().bulk_in(buffer, this->soon()), ErrorCode::disconnected);
  this->expect_refused(this->endpoint().control_out(kStore, {}, this->soon()),
                       ErrorCode::disconnected);
  this->expect_refused(this->endpoint().submit(read), ErrorCode::disconnected);
  this->expect_refused(this->endpoint().reopen(), ErrorCode::disconnected);
}

TYPED_TEST_P(UsbEndpointContract, ReturnedDeviceWorksOnceReopened) {
  this->rig_.unplug();
  this->rig_.clock().sleep_until(this->soon());
  this->rig_.plug_in();
  EXPECT_EQ(this->endpoint().state(), UsbState::returned);
  std::array<std::byte, 64> buffer;
  this->expect_refused(this->endpoint().bulk_in(buffer, this->soon()), ErrorCode::invalid_state);
  ASSERT_TRUE(this->endpoint().reopen());
  EXPECT_EQ(this->endpoint().state(), UsbState::attached);
  EXPECT_TRUE(this->endpoint().reopen());
  ASSERT_TRUE(this->endpoint().bulk_out(this->bytes(16), this->soon()));
  EXPECT_EQ(this->endpoint().bulk_in(buffer, this->soon()), 16U);
}

REGISTER_TYPED_TEST_SUITE_P(
    UsbEndpointContract, EchoesWhatWasSent, ShortPacketEndsALongRead,
    ReadThatIsNeverEndedGivesWhatCameByTheDeadline, SilenceLastsUntilTheDeadline,
    EmptyReadIsRefused, PacketLongerThanTheRoomOverflows, ControlRequestsReachTheDevice,
    UnknownRequestStallsOnceAndDoesNoHarm, SetupThatContradictsTheCallIsRefused,
    ReadInFlightIsDoneWhenTheAnswerComes, TransfersOfOneDirectionKeepTheirOrder,
    DoneTransferCanFlyAgain, CancelledTransferIsDoneAndItsAnswerGoesToTheNext, OnlySoManyFlyAtOnce,
    WaitingForWhatWasNeverSubmittedIsRefused, StoppedDeviceTimesOutAndIsWellAgain,
    UnplugEndsWhatIsInFlightAndIsSeenAsDetached, ReturnedDeviceWorksOnceReopened);

}  // namespace tactus::hal
