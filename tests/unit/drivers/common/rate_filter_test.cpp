#include "drivers/common/rate_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kTick_ns = 1'000'000;

TEST(RateFilter, ComesToTheSlopeOfARamp) {
  RateFilter filter(100.0);
  double rate = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    rate = filter.update(3.0 + 0.002 * tick, tick * kTick_ns);
  }
  EXPECT_NEAR(rate, 2.0, 1e-9);
}

TEST(RateFilter, TakesThreeQuartersOfAStepInAboutTwoTimeConstants) {
  RateFilter filter(10.0);
  filter.update(0.0, 0);
  double rate = 0.0;
  for (int tick = 1; tick <= 32; ++tick) {  // 2 / (2 pi 10 Hz)
    rate = filter.update(0.001 * tick, tick * kTick_ns);
  }
  EXPECT_NEAR(rate, 1.0 - std::exp(-2.0), 0.02);
}

TEST(RateFilter, FirstPositionAndARestartHaveNoRate) {
  RateFilter filter(100.0);
  EXPECT_EQ(filter.update(5.0, kTick_ns), 0.0);
  EXPECT_GT(filter.update(6.0, 2 * kTick_ns), 0.0);
  filter.restart();
  EXPECT_EQ(filter.update(-100.0, 3 * kTick_ns), 0.0);
}

TEST(RateFilter, TheSameSampleTwiceChangesNothing) {
  RateFilter filter(100.0);
  filter.update(0.0, kTick_ns);
  const double rate = filter.update(0.1, 2 * kTick_ns);
  EXPECT_EQ(filter.update(0.1, 2 * kTick_ns), rate);
}

TEST(RateFilter, LateSampleCountsForTheTimeThatPassed) {
  RateFilter filter(1e6);  // no smoothing to speak of
  filter.update(0.0, 0);
  EXPECT_NEAR(filter.update(0.01, 5 * kTick_ns), 2.0, 1e-3);
}

}  // namespace
}  // namespace tactus::drivers
