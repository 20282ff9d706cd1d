#include "drivers/common/repeat_timer.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr double kRepeat_s = 0.02;
constexpr hal::TimeNs kRepeat_ns = 20'000'000;

TEST(RepeatTimer, TheFirstFrameIsDueAtOnceAndTheNextAfterThePeriod) {
  RepeatTimer timer;
  EXPECT_TRUE(timer.is_due(kRepeat_s, 5));
  EXPECT_FALSE(timer.has_sent());
  timer.sent(5);
  EXPECT_TRUE(timer.has_sent());
  EXPECT_FALSE(timer.is_due(kRepeat_s, 5));
  EXPECT_FALSE(timer.is_due(kRepeat_s, 4 + kRepeat_ns));
  EXPECT_TRUE(timer.is_due(kRepeat_s, 5 + kRepeat_ns));
}

TEST(RepeatTimer, AFrameThatFoundNoRoomIsDueAgain) {
  RepeatTimer timer;
  timer.tried(true, 5);
  EXPECT_FALSE(timer.is_due(kRepeat_s, 6));
  timer.tried(false, 6);
  EXPECT_TRUE(timer.is_due(kRepeat_s, 6));
  EXPECT_FALSE(timer.has_sent());
}

TEST(RepeatTimer, ARestartMakesTheNextFrameTheFirst) {
  RepeatTimer timer;
  timer.sent(5);
  timer.restart();
  EXPECT_TRUE(timer.is_due(kRepeat_s, 5));
  EXPECT_FALSE(timer.has_sent());
}

}  // namespace
}  // namespace tactus::drivers
