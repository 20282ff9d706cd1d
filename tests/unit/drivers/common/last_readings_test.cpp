#include "drivers/common/last_readings.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kReadings_ms = 1'000'000;
constexpr double kFastest_rad_per_s = 60.0;

TEST(LastReadings, AJumpIsMeasuredFromTheNewestReadingOfAnotherTime) {
  LastReadings<int> readings;
  readings.take(1, 10 * kReadings_ms);
  readings.take(2, 11 * kReadings_ms);
  EXPECT_EQ(readings.before(12 * kReadings_ms), 2);
  EXPECT_EQ(readings.before(11 * kReadings_ms), 1);
  readings.take(3, 11 * kReadings_ms);
  EXPECT_EQ(readings.before(12 * kReadings_ms), 3);
  EXPECT_EQ(readings.before(11 * kReadings_ms), 1);
}

TEST(LastReadings, TheReachGrowsWithTheGapUpToTenMilliseconds) {
  LastReadings<int> readings;
  readings.take(1, 10 * kReadings_ms);
  EXPECT_DOUBLE_EQ(readings.reach_rad(kFastest_rad_per_s, 12 * kReadings_ms), 0.12);
  EXPECT_DOUBLE_EQ(readings.reach_rad(kFastest_rad_per_s, 500 * kReadings_ms), 0.6);
  EXPECT_EQ(readings.reach_rad(kFastest_rad_per_s, 9 * kReadings_ms), 0.0);
}

}  // namespace
}  // namespace tactus::drivers
