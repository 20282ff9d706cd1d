// The contract of every Counter. A rig has a counter just opened that wraps at kRigCeiling or at
// what `start` asks for, whichever is less:
//   Counter& counter(), Clock& clock()
//   void move(steps)    turns the encoder
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "hal/counter.h"

namespace tactus::hal {

inline constexpr std::uint64_t kRigCeiling = 999;

template <class Rig>
class CounterContract : public ::testing::Test {
 protected:
  Counter& counter() { return rig_.counter(); }
  std::uint64_t count() {
    const auto reading = counter().read();
    EXPECT_TRUE(reading);
    return reading ? reading->count : ~std::uint64_t{0};
  }
  template <class T>
  void expect_refused(const Result<T>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }
  Rig rig_;
};

TYPED_TEST_SUITE_P(CounterContract);

TYPED_TEST_P(CounterContract, CountsBothWays) {
  ASSERT_TRUE(this->counter().start({}));
  const auto start = this->count();
  this->rig_.move(70);
  const auto there = this->count();
  EXPECT_EQ(count_difference(start, there, this->counter().ceiling()), 70);
  this->rig_.move(-100);
  EXPECT_EQ(count_difference(there, this->count(), this->counter().ceiling()), -100);
}

TYPED_TEST_P(CounterContract, WrapsAtTheHardwaresCeilingUnlessTold) {
  ASSERT_TRUE(this->counter().start({}));
  EXPECT_EQ(this->counter().ceiling(), kRigCeiling);
  const auto start = this->count();
  this->rig_.move(static_cast<std::int64_t>(kRigCeiling - start));
  EXPECT_EQ(this->count(), kRigCeiling);
  this->rig_.move(1);
  EXPECT_EQ(this->count(), 0U);
  this->rig_.move(-1);
  EXPECT_EQ(this->count(), kRigCeiling);
}

TYPED_TEST_P(CounterContract, TakesALowerCeiling) {
  ASSERT_TRUE(this->counter().start({.ceiling = 399}));
  EXPECT_EQ(this->counter().ceiling(), 399U);
}

TYPED_TEST_P(CounterContract, ReadingIsNoOlderThanItSays) {
  ASSERT_TRUE(this->counter().start({}));
  const TimeNs before_ns = this->rig_.clock().now_ns();
  const auto reading = this->counter().read();
  ASSERT_TRUE(reading);
  EXPECT_GE(reading->time_ns, before_ns);
  EXPECT_LE(reading->time_ns, this->rig_.clock().now_ns());
}

TYPED_TEST_P(CounterContract, CallsOutOfOrderAreRefused) {
  std::array<CounterIndexEvent, 1> one;
  this->expect_refused(this->counter().read(), ErrorCode::invalid_state);
  this->expect_refused(this->counter().read_index(one, kNoWait), ErrorCode::invalid_state);
  ASSERT_TRUE(this->counter().start({}));
  this->expect_refused(this->counter().read_index(one, kNoWait), ErrorCode::invalid_state);
}

REGISTER_TYPED_TEST_SUITE_P(CounterContract, CountsBothWays, WrapsAtTheHardwaresCeilingUnlessTold,
                            TakesALowerCeiling, ReadingIsNoOlderThanItSays,
                            CallsOutOfOrderAreRefused);

}  // namespace tactus::hal
