// The contract of every SerialPort. A rig has a device at the other end of the line:
//   SerialPort& port(), Clock& clock()
//   void answer(std::span<const std::byte>)          the device sends
//   std::size_t hear(std::span<std::byte>)           what the device got, as much as there is
//   void unplug(), void plug_in()
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "hal/serial_port.h"

namespace tactus::hal {

template <class Rig>
class SerialPortContract : public ::testing::Test {
 protected:
  SerialPort& port() { return rig_.port(); }
  TimeNs soon() { return rig_.clock().now_ns() + 200'000'000; }

  // All values of a byte, so that a line that changes some of them shows.
  static std::vector<std::byte> bytes(std::size_t count) {
    std::vector<std::byte> all(count);
    std::ranges::generate(all, [next = 0U]() mutable { return static_cast<std::byte>(next++); });
    return all;
  }

  std::vector<std::byte> heard(std::size_t count) {
    std::vector<std::byte> all(count);
    std::size_t got = 0;
    const TimeNs deadline_ns = soon();
    while (got < count && rig_.clock().now_ns() < deadline_ns) {
      got += rig_.hear(std::span(all).subspan(got));
      rig_.clock().sleep_until(rig_.clock().now_ns() + 1'000'000);
    }
    all.resize(got);
    return all;
  }

  template <class T>
  void expect_refused(const Result<T>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }

  Rig rig_;
};

TYPED_TEST_SUITE_P(SerialPortContract);

TYPED_TEST_P(SerialPortContract, EveryByteGoesOutAsItIs) {
  const auto sent = this->bytes(256);
  ASSERT_EQ(this->port().write(sent, this->soon()), sent.size());
  EXPECT_EQ(this->heard(sent.size()), sent);
}

TYPED_TEST_P(SerialPortContract, EveryByteComesInAsItIs) {
  const auto sent = this->bytes(256);
  this->rig_.answer(sent);
  std::vector<std::byte> got(sent.size());
  ASSERT_EQ(this->port().read_all(got, this->soon()), sent.size());
  EXPECT_EQ(got, sent);
}

TYPED_TEST_P(SerialPortContract, ReadReturnsWhatIsThereWithoutWaitingForMore) {
  this->rig_.answer(this->bytes(3));
  std::array<std::byte, 16> buffer;
  std::size_t got = 0;
  while (got < 3) {
    const auto some = this->port().read(std::span(buffer).subspan(got), this->soon());
    ASSERT_TRUE(some);
    got += *some;
  }
  EXPECT_EQ(got, 3U);
}

TYPED_TEST_P(SerialPortContract, WhatDoesNotFitStaysForTheNextRead) {
  const auto sent = this->bytes(5);
  this->rig_.answer(sent);
  std::array<std::byte, 5> got{};
  ASSERT_EQ(this->port().read_all(std::span(got).first(2), this->soon()), 2U);
  ASSERT_EQ(this->port().read_all(std::span(got).subspan(2), this->soon()), 3U);
  EXPECT_TRUE(std::ranges::equal(got, sent));
}

TYPED_TEST_P(SerialPortContract, ReadOfAllGivesWhatCameByTheDeadline) {
  this->rig_.answer(this->bytes(3));
  std::array<std::byte, 16> buffer;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 20'000'000;
  EXPECT_EQ(this->port().read_all(buffer, deadline_ns), 3U);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
}

TYPED_TEST_P(SerialPortContract, SilenceLastsUntilTheDeadline) {
  std::array<std::byte, 16> buffer;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 5'000'000;
  this->expect_refused(this->port().read(buffer, deadline_ns), ErrorCode::timeout);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
  this->expect_refused(this->port().read(buffer, kNoWait), ErrorCode::timeout);
}

TYPED_TEST_P(SerialPortContract, ReadWithoutRoomIsRefusedAndAnEmptyWriteIsNothing) {
  this->expect_refused(this->port().read({}, this->soon()), ErrorCode::invalid_argument);
  this->expect_refused(this->port().read_all({}, this->soon()), ErrorCode::invalid_argument);
  EXPECT_EQ(this->port().write({}, kNoWait), 0U);
}

TYPED_TEST_P(SerialPortContract, DiscardedInputIsGone) {
  this->rig_.answer(this->bytes(7));
  this->rig_.clock().sleep_until(this->rig_.clock().now_ns() + 10'000'000);
  ASSERT_TRUE(this->port().discard_input());
  std::array<std::byte, 16> buffer;
  this->expect_refused(this->port().read(buffer, kNoWait), ErrorCode::timeout);
  this->rig_.answer(this->bytes(2));
  EXPECT_EQ(this->port().read_all(std::span(buffer).first(2), this->soon()), 2U);
}

TYPED_TEST_P(SerialPortContract, DeviceThatTakesNothingMoreLetsTheDeadlinePass) {
  const auto much = this->bytes(4096);
  Result<std::size_t> taken = std::size_t{0};
  for (int i = 0; i < 1000 && taken; ++i) {
    taken = this->port().write(much, kNoWait);
  }
  this->expect_refused(taken, ErrorCode::timeout);
}

TYPED_TEST_P(SerialPortContract, UnpluggedDeviceIsDisconnectedUntilReopened) {
  this->rig_.unplug();
  std::array<std::byte, 16> buffer;
  this->expect_refused(this->port().read(buffer, this->soon()), ErrorCode::disconnected);
  this->expect_refused(this->port().write(this->bytes(1), this->soon()), ErrorCode::disconnected);
  this->expect_refused(this->port().discard_input(), ErrorCode::disconnected);
  this->expect_refused(this->port().reopen(), ErrorCode::disconnected);
  this->rig_.plug_in();
  this->expect_refused(this->port().read(buffer, kNoWait), ErrorCode::disconnected);
  ASSERT_TRUE(this->port().reopen());
  const auto sent = this->bytes(3);
  ASSERT_EQ(this->port().write(sent, this->soon()), sent.size());
  EXPECT_EQ(this->heard(sent.size()), sent);
}

REGISTER_TYPED_TEST_SUITE_P(SerialPortContract, EveryByteGoesOutAsItIs, EveryByteComesInAsItIs,
                            ReadReturnsWhatIsThereWithoutWaitingForMore,
                            WhatDoesNotFitStaysForTheNextRead, ReadOfAllGivesWhatCameByTheDeadline,
                            SilenceLastsUntilTheDeadline,
                            ReadWithoutRoomIsRefusedAndAnEmptyWriteIsNothing, DiscardedInputIsGone,
                            DeviceThatTakesNothingMoreLetsTheDeadlinePass,
                            UnpluggedDeviceIsDisconnectedUntilReopened);

}  // namespace tactus::hal
