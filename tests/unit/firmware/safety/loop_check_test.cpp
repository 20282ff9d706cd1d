#include "firmware/safety/loop_check.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

constexpr LoopReport kLate{.status = kLoopLate, .missed_ticks = 0};

class LoopCheckTest : public ::testing::Test {
 protected:
  LoopCheckTest() { check_.configure({}); }  // 1 kHz, three late ticks, a gap of 5 ms
  LoopCheck check_;
};

TEST_F(LoopCheckTest, ATickInTimeIsWell) {
  EXPECT_EQ(check_.check({}), kNoFault);
  EXPECT_EQ(check_.late_count(), 0U);
}

TEST_F(LoopCheckTest, TheThirdLateTickInARowIsAFaultAndTwoAreNot) {
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(check_.check(kLate), kLimitLateTick);
    EXPECT_EQ(check_.check(kLate), kLimitLateTick);
    EXPECT_EQ(check_.check({}), kNoFault);
  }
  check_.check(kLate);
  check_.check(kLate);
  EXPECT_EQ(check_.check(kLate), kLimitLateTick | kFaultLateTicks);
  EXPECT_EQ(check_.check(kLate), kLimitLateTick | kFaultLateTicks);
  EXPECT_EQ(check_.late_count(), 10U);
}

TEST_F(LoopCheckTest, ATickAfterMissedOnesIsLate) {
  EXPECT_EQ(check_.check({.status = kLoopOnTime, .missed_ticks = 4}), kLimitLateTick);
}

TEST_F(LoopCheckTest, AGapOfTheLongestTimeIsAnOverrunAtAnyRate) {
  EXPECT_EQ(check_.check({.status = kLoopOnTime, .missed_ticks = 5}),
            kLimitLateTick | kFaultTickOverrun);
  ControllerConfig fast;
  fast.rate_hz = 8000.0;
  check_.configure(fast);
  EXPECT_EQ(check_.check({.status = kLoopOnTime, .missed_ticks = 39}), kLimitLateTick);
  EXPECT_EQ(check_.check({.status = kLoopOnTime, .missed_ticks = 40}),
            kLimitLateTick | kFaultTickOverrun);
}

TEST_F(LoopCheckTest, AWatchdogThatCannotBeDrivenIsAFaultAtOnce) {
  EXPECT_EQ(check_.check({.status = kLoopWatchdogLost, .missed_ticks = 0}), kFaultWatchdog);
}

TEST_F(LoopCheckTest, ACrashBesideTheLoopIsAFaultAtOnce) {
  EXPECT_EQ(check_.check({.status = kLoopHelperCrashed, .missed_ticks = 0}), kFaultHelperCrashed);
}

TEST_F(LoopCheckTest, ALostLineToASupervisingHostIsAFaultAtOnce) {
  EXPECT_EQ(check_.check({.status = kLoopLineLost, .missed_ticks = 0}), kFaultLineLost);
}

}  // namespace
}  // namespace tactus::firmware
