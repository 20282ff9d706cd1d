// The contract of every CanBus. A rig has two nodes of one network on which nobody else speaks:
//   CanBus& left(), CanBus& right(), Clock& clock()
//   void set_link_up(bool)   takes the network interface of `left` down and up again
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "hal/can_bus.h"
#include "tests/unit/hal/same_frame.h"

namespace tactus::hal {

inline CanFrame can_frame(std::uint32_t id, std::initializer_list<int> bytes) {
  CanFrame frame{.id = id, .length = static_cast<std::uint8_t>(bytes.size())};
  std::ranges::transform(bytes, frame.data.begin(),
                         [](int value) { return static_cast<std::byte>(value); });
  return frame;
}

template <class T>
std::optional<ErrorCode> code_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error().code);
}

template <class Rig>
class CanBusContract : public ::testing::Test {
 protected:
  static constexpr TimeNs kPatience = 100'000'000;

  CanBus& left() { return rig_.left(); }
  CanBus& right() { return rig_.right(); }
  TimeNs soon() { return rig_.clock().now_ns() + kPatience; }

  // Everything that arrives at `bus` until nothing more does.
  std::vector<CanReceived> drain(CanBus& bus) {
    std::vector<CanReceived> all;
    std::array<CanReceived, 16> some;
    while (true) {
      const auto count = bus.receive(some, soon());
      if (!count) {
        EXPECT_EQ(count.error().code, ErrorCode::timeout);
        return all;
      }
      all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(*count));
    }
  }

  Rig rig_;
};

TYPED_TEST_SUITE_P(CanBusContract);

TYPED_TEST_P(CanBusContract, DeliversWhatTheOtherNodeSent) {
  std::vector<CanFrame> sent{can_frame(0, {}), can_frame(0x7FF, {1, 2, 3, 4, 5, 6, 7, 255}),
                             can_frame(0x123, {9})};
  sent[2].extended = true;
  sent.push_back({.id = 0x1FFF'FFFF, .extended = true, .remote = true, .length = 4});
  for (const CanFrame& frame : sent) {
    ASSERT_TRUE(this->left().send(frame));
  }
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(received[i].kind, CanReceived::Kind::frame);
    expect_same(received[i].frame, sent[i]);
  }
}

TYPED_TEST_P(CanBusContract, NodeDoesNotHearItself) {
  ASSERT_TRUE(this->left().send(can_frame(1, {1})));
  EXPECT_TRUE(this->drain(this->left()).empty());
}

TYPED_TEST_P(CanBusContract, BatchKeepsItsOrder) {
  std::array<CanFrame, 8> batch;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    batch[i] = can_frame(static_cast<std::uint32_t>(100 - i), {static_cast<int>(i)});
  }
  EXPECT_EQ(this->left().send(batch), batch.size());
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    expect_same(received[i].frame, batch[i]);
  }
}

TYPED_TEST_P(CanBusContract, SmallBufferTakesTheOldestAndLeavesTheRest) {
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(this->left().send(can_frame(1, {i})));
  }
  std::array<CanReceived, 3> some;
  std::vector<std::byte> seen;
  while (seen.size() < 5) {
    const auto count = this->right().receive(some, this->soon());
    ASSERT_TRUE(count);
    ASSERT_LE(*count, some.size());
    for (std::size_t i = 0; i < *count; ++i) {
      seen.push_back(some[i].frame.data[0]);
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(seen));
}

TYPED_TEST_P(CanBusContract, MalformedFrameStopsTheWholeBatch) {
  const std::array<CanFrame, 2> batch{can_frame(1, {1}), CanFrame{.id = 0x800}};
  EXPECT_EQ(code_of(this->left().send(batch)), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of(this->left().send(CanFrame{.length = 9})), ErrorCode::invalid_argument);
  EXPECT_TRUE(this->drain(this->right()).empty());
  EXPECT_EQ(this->left().counters().sent, 0U);
}

TYPED_TEST_P(CanBusContract, SendingNothingIsNoError) {
  EXPECT_EQ(this->left().send(std::span<const CanFrame>{}), 0U);
}

TYPED_TEST_P(CanBusContract, CarriesFdWhereItSaysSo) {
  CanFrame frame{.id = 5, .fd = true, .bit_rate_switch = true, .length = 48};
  frame.data.fill(std::byte{0x5A});
  if (!this->left().fd_enabled()) {
    EXPECT_EQ(code_of(this->left().send(frame)), ErrorCode::not_supported);
    return;
  }
  ASSERT_TRUE(this->left().send(frame));
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), 1U);
  expect_same(received[0].frame, frame);
}

TYPED_TEST_P(CanBusContract, SilenceLastsUntilTheDeadline) {
  std::array<CanReceived, 1> one;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 2'000'000;
  EXPECT_EQ(code_of(this->right().receive(one, deadline_ns)), ErrorCode::timeout);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
}

TYPED_TEST_P(CanBusContract, PassedDeadlineTakesWhatIsThere) {
  std::array<CanReceived, 4> some;
  EXPECT_EQ(code_of(this->right().receive(some, kNoWait)), ErrorCode::timeout);
  ASSERT_TRUE(this->left().send(can_frame(1, {1})));
  ASSERT_EQ(this->right().receive(std::span(some).first(1), this->soon()), 1U);
  ASSERT_TRUE(this->left().send(can_frame(2, {2})));
  this->rig_.clock().sleep_until(this->soon());
  EXPECT_EQ(this->right().receive(some, kNoWait), 1U);
}

TYPED_TEST_P(CanBusContract, ReceiveTimeIsOnTheClock) {
  const TimeNs before_ns = this->rig_.clock().now_ns();
  ASSERT_TRUE(this->left().send(can_frame(1, {1})));
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), 1U);
  EXPECT_GE(received[0].time_ns, before_ns);
  EXPECT_LE(received[0].time_ns, this->rig_.clock().now_ns());
}

TYPED_TEST_P(CanBusContract, OnlyWhatPassesAFilterIsQueued) {
  const std::array filters{CanFilter::standard(0x10), CanFilter{.word = 0x200, .mask = 0x700}};
  ASSERT_TRUE(this->right().set_filters(filters));
  for (const std::uint32_t id : {0x10U, 0x11U, 0x1FFU, 0x200U, 0x2FFU, 0x300U}) {
    ASSERT_TRUE(this->left().send(can_frame(id, {})));
  }
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), 3U);
  EXPECT_EQ(received[0].frame.id, 0x10U);
  EXPECT_EQ(received[1].frame.id, 0x200U);
  EXPECT_EQ(received[2].frame.id, 0x2FFU);
}

TYPED_TEST_P(CanBusContract, FrameThatPassesTwoFiltersComesOnce) {
  const std::array filters{CanFilter::standard(0x10), CanFilter::everything()};
  ASSERT_TRUE(this->right().set_filters(filters));
  ASSERT_TRUE(this->left().send(can_frame(0x10, {})));
  EXPECT_EQ(this->drain(this->right()).size(), 1U);
}

TYPED_TEST_P(CanBusContract, InvertedFilterPassesTheRest) {
  CanFilter filter = CanFilter::standard(0x10);
  filter.inverted = true;
  ASSERT_TRUE(this->right().set_filters(std::span(&filter, 1)));
  ASSERT_TRUE(this->left().send(can_frame(0x10, {})));
  ASSERT_TRUE(this->left().send(can_frame(0x11, {})));
  const auto received = this->drain(this->right());
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].frame.id, 0x11U);
}

TYPED_TEST_P(CanBusContract, NoFilterMeansNoFrame) {
  ASSERT_TRUE(this->right().set_filters({}));
  ASSERT_TRUE(this->left().send(can_frame(1, {})));
  EXPECT_TRUE(this->drain(this->right()).empty());
  const CanFilter everything = CanFilter::everything();
  ASSERT_TRUE(this->right().set_filters(std::span(&everything, 1)));
  ASSERT_TRUE(this->left().send(can_frame(1, {})));
  EXPECT_EQ(this->drain(this->right()).size(), 1U);
}

TYPED_TEST_P(CanBusContract, TooManyFiltersAreRefused) {
  const std::vector<CanFilter> many(kMaxCanFilters + 1);
  EXPECT_EQ(code_of(this->right().set_filters(many)), ErrorCode::invalid_argument);
  EXPECT_TRUE(this->right().set_filters(std::span(many).first(kMaxCanFilters)));
}

TYPED_TEST_P(CanBusContract, EmptyBufferIsRefused) {
  EXPECT_EQ(code_of(this->right().receive({}, kNoWait)), ErrorCode::invalid_argument);
}

TYPED_TEST_P(CanBusContract, LinkThatIsDownSaysSoAndComesBack) {
  this->rig_.set_link_up(false);
  std::array<CanReceived, 4> some;
  EXPECT_EQ(code_of(this->left().send(can_frame(1, {}))), ErrorCode::link_down);
  EXPECT_EQ(code_of(this->left().receive(some, this->soon())), ErrorCode::link_down);
  EXPECT_EQ(this->left().status().state, CanState::stopped);
  EXPECT_EQ(code_of(this->left().restart()), ErrorCode::link_down);
  this->rig_.set_link_up(true);
  ASSERT_TRUE(this->right().send(can_frame(2, {})));
  EXPECT_EQ(this->left().receive(some, this->soon()), 1U);
  EXPECT_TRUE(this->left().send(can_frame(3, {})));
  EXPECT_EQ(this->left().status().state, CanState::error_active);
}

TYPED_TEST_P(CanBusContract, WhatCameBeforeTheLinkWentDownIsHandedOut) {
  ASSERT_TRUE(this->right().send(can_frame(7, {})));
  this->rig_.clock().sleep_until(this->soon());
  this->rig_.set_link_up(false);
  std::array<CanReceived, 4> some;
  EXPECT_EQ(this->left().receive(some, this->soon()), 1U);
  EXPECT_EQ(code_of(this->left().receive(some, this->soon())), ErrorCode::link_down);
}

TYPED_TEST_P(CanBusContract, RestartIsForBusOffOnly) {
  const auto restarted = this->left().restart();
  ASSERT_FALSE(restarted);
  EXPECT_TRUE(restarted.error().code == ErrorCode::invalid_state ||
              restarted.error().code == ErrorCode::not_supported ||
              restarted.error().code == ErrorCode::not_permitted);
}

TYPED_TEST_P(CanBusContract, CountersAccountForEveryFrame) {
  std::uint64_t refused = 0;
  for (int i = 0; i < 2000; ++i) {
    if (!this->left().send(can_frame(1, {1, 2, 3, 4, 5, 6, 7, 8}))) {
      ++refused;
    }
  }
  const std::size_t first = this->drain(this->right()).size();
  // A frame that comes after a loss brings the news of it.
  ASSERT_TRUE(this->left().send(can_frame(2, {})));
  ASSERT_EQ(this->drain(this->right()).size(), 1U);
  EXPECT_EQ(this->left().counters().sent, 2001 - refused);
  EXPECT_EQ(this->left().counters().send_refused, refused);
  EXPECT_EQ(this->right().counters().received, first + 1);
  EXPECT_EQ(this->right().counters().received + this->right().counters().receive_dropped,
            this->left().counters().sent);
}

REGISTER_TYPED_TEST_SUITE_P(
    CanBusContract, DeliversWhatTheOtherNodeSent, NodeDoesNotHearItself, BatchKeepsItsOrder,
    SmallBufferTakesTheOldestAndLeavesTheRest, MalformedFrameStopsTheWholeBatch,
    SendingNothingIsNoError, CarriesFdWhereItSaysSo, SilenceLastsUntilTheDeadline,
    PassedDeadlineTakesWhatIsThere, ReceiveTimeIsOnTheClock, OnlyWhatPassesAFilterIsQueued,
    FrameThatPassesTwoFiltersComesOnce, InvertedFilterPassesTheRest, NoFilterMeansNoFrame,
    TooManyFiltersAreRefused, EmptyBufferIsRefused, LinkThatIsDownSaysSoAndComesBack,
    WhatCameBeforeTheLinkWentDownIsHandedOut, RestartIsForBusOffOnly, CountersAccountForEveryFrame);

}  // namespace tactus::hal
