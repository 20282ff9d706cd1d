// The contract of every Counter with an index signal, besides that of every Counter. The rig also
// has:
//   void pulse_index()
#pragma once

#include "tests/unit/hal/counter_contract.h"

namespace tactus::hal {

template <class Rig>
class CounterIndexContract : public CounterContract<Rig> {};

TYPED_TEST_SUITE_P(CounterIndexContract);

TYPED_TEST_P(CounterIndexContract, IndexPulsesCarryTheirCount) {
  ASSERT_TRUE(this->counter().start({.watch_index = true}));
  const auto start = this->count();
  this->rig_.move(5);
  this->rig_.pulse_index();
  this->rig_.move(20);
  this->rig_.pulse_index();
  std::array<CounterIndexEvent, 1> one;
  EXPECT_EQ(this->counter().read_index(one, kNoWait), 1U);
  EXPECT_EQ(count_difference(start, one[0].count, kRigCeiling), 5);
  EXPECT_EQ(this->counter().read_index(one, kForever), 1U);
  EXPECT_EQ(count_difference(start, one[0].count, kRigCeiling), 25);
  this->expect_refused(this->counter().read_index(one, kNoWait), ErrorCode::timeout);
}

TYPED_TEST_P(CounterIndexContract, SilentIndexLastsUntilTheDeadline) {
  ASSERT_TRUE(this->counter().start({.watch_index = true}));
  std::array<CounterIndexEvent, 1> one;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 2'000'000;
  this->expect_refused(this->counter().read_index(one, deadline_ns), ErrorCode::timeout);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
}

TYPED_TEST_P(CounterIndexContract, NoRoomForEventsIsRefused) {
  ASSERT_TRUE(this->counter().start({.watch_index = true}));
  this->expect_refused(this->counter().read_index({}, kNoWait), ErrorCode::invalid_argument);
}

REGISTER_TYPED_TEST_SUITE_P(CounterIndexContract, IndexPulsesCarryTheirCount,
                            SilentIndexLastsUntilTheDeadline, NoRoomForEventsIsRefused);

}  // namespace tactus::hal
