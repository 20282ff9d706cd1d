#include "drivers/common/counted_shaft.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numbers>

#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kShaftMs = 1'000'000;
constexpr CountedShaftConfig kThousandthRad{
    .rad_per_count = 1e-3, .max_speed_rad_per_s = 100.0, .jump_margin_rad = 0.01};

TEST(CountedShaft, FirstCountIsTheAngle) {
  CountedShaft shaft(kThousandthRad);
  EXPECT_TRUE(shaft.take(-5000, 0));
  EXPECT_DOUBLE_EQ(shaft.position_rad(), -5.0);
}

TEST(CountedShaft, AngleRunsOnWhereTheCounterWraps) {
  constexpr std::int32_t kTop = std::numeric_limits<std::int32_t>::max();
  CountedShaft shaft(kThousandthRad);
  ASSERT_TRUE(shaft.take(kTop - 10, 0));
  const double before_rad = shaft.position_rad();
  ASSERT_TRUE(shaft.take(std::numeric_limits<std::int32_t>::min() + 9, kShaftMs));
  EXPECT_NEAR(shaft.position_rad() - before_rad, 0.020, 1e-9);
  ASSERT_TRUE(shaft.take(kTop - 10, 2 * kShaftMs));
  EXPECT_NEAR(shaft.position_rad(), before_rad, 1e-9);
}

// 100 rad/s for 1 ms are 100 counts, the margin 10 more.
TEST(CountedShaft, ReachIsTheSpeedTimesTheTimeAndTheMargin) {
  for (const std::int32_t way : {1, -1}) {
    CountedShaft shaft(kThousandthRad);
    ASSERT_TRUE(shaft.take(0, 0));
    EXPECT_FALSE(shaft.take(111 * way, kShaftMs));
    EXPECT_DOUBLE_EQ(shaft.position_rad(), 0.0);
    EXPECT_TRUE(shaft.take(110 * way, kShaftMs));
  }
}

TEST(CountedShaft, TimeThatGoesBackIsNoTime) {
  CountedShaft shaft(kThousandthRad);
  ASSERT_TRUE(shaft.take(0, 5 * kShaftMs));
  EXPECT_FALSE(shaft.take(11, 0));
  EXPECT_TRUE(shaft.take(10, 0));
}

TEST(CountedShaft, ManyCountsAtOneTimeMoveItByTheMarginAlone) {
  CountedShaft shaft(kThousandthRad);
  ASSERT_TRUE(shaft.take(0, 0));
  ASSERT_TRUE(shaft.take(5, kShaftMs));
  EXPECT_TRUE(shaft.take(15, kShaftMs));
  EXPECT_FALSE(shaft.take(16, kShaftMs));
  EXPECT_TRUE(shaft.take(-5, kShaftMs));
  EXPECT_FALSE(shaft.take(-6, kShaftMs));
}

TEST(CountedShaft, ResumedShaftMayBeElsewhereAndKeepsItsTurns) {
  CountedShaft shaft(kThousandthRad);
  ASSERT_TRUE(shaft.take(std::numeric_limits<std::int32_t>::max(), 0));
  ASSERT_TRUE(shaft.take(std::numeric_limits<std::int32_t>::min(), kShaftMs));
  const double before_rad = shaft.position_rad();
  shaft.resume();
  ASSERT_TRUE(shaft.take(std::numeric_limits<std::int32_t>::min() + 50'000, 2 * kShaftMs));
  EXPECT_NEAR(shaft.position_rad() - before_rad, 50.0, 1e-6);
  EXPECT_FALSE(shaft.take(std::numeric_limits<std::int32_t>::min(), 3 * kShaftMs));
}

TEST(CountedShaft, VelocityOfASteadyTurnIsItsSpeed) {
  CountedShaftConfig config = kThousandthRad;
  config.velocity_filter_s = 0.002;
  CountedShaft shaft(config);
  for (std::int32_t tick = 0; tick < 50; ++tick) {
    ASSERT_TRUE(shaft.take(-7 * tick, tick * kShaftMs));
  }
  EXPECT_NEAR(shaft.velocity_rad_per_s(), -7.0, 1e-6);
}

// The count equals the sum of the believed steps, at any place of the counter.
TEST(CountedShaft, RandomWalkIsFollowedOverAnyNumberOfWraps) {
  hal::Random random(402);
  CountedShaftConfig config = kThousandthRad;
  config.max_speed_rad_per_s = 1e9;
  CountedShaft shaft(config);
  auto truth = static_cast<std::int64_t>(random.below(1'000'000));
  ASSERT_TRUE(shaft.take(static_cast<std::int32_t>(truth), 0));
  for (hal::TimeNs tick = 1; tick <= 10'000; ++tick) {
    truth += static_cast<std::int64_t>(random.below(1'500'000'000)) - 700'000'000;
    ASSERT_TRUE(shaft.take(static_cast<std::int32_t>(truth), tick * 1000 * kShaftMs));
  }
  EXPECT_NEAR(shaft.position_rad(), 1e-3 * static_cast<double>(truth), 1e-3);
}

}  // namespace
}  // namespace tactus::drivers
