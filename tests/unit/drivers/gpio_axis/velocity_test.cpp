#include "drivers/gpio_axis/count_velocity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kWindow_ns = 1'000'000;
constexpr hal::TimeNs kSecond_ns = 1'000'000'000;

TEST(CountVelocity, IsZeroBeforeTwoEdges) {
  CountVelocity velocity(kWindow_ns);
  EXPECT_EQ(velocity.at(0), 0.0);
  velocity.saw(1, 1000);
  EXPECT_EQ(velocity.at(2000), 0.0);
}

TEST(CountVelocity, IsExactForEvenEdgesAtAnySpeed) {
  for (const double counts_per_s : {20.0, 300.0, 5000.0, 80'000.0, -900.0}) {
    CountVelocity velocity(kWindow_ns);
    const double apart_ns = 1e9 / std::abs(counts_per_s);
    const int sign = counts_per_s < 0.0 ? -1 : 1;
    hal::TimeNs last_ns = 0;
    for (int i = 0; i < 100; ++i) {
      last_ns = kSecond_ns + std::llround(apart_ns * i);
      velocity.saw(2 * sign * i + 1, last_ns);
    }
    EXPECT_NEAR(velocity.at(last_ns) / counts_per_s, 1.0, 1e-4);
  }
}

TEST(CountVelocity, DecaysAsOneCountOverTheSilenceAndThenStands) {
  CountVelocity velocity(kWindow_ns);
  velocity.saw(1, kSecond_ns);
  velocity.saw(3, kSecond_ns + 1'000'000);
  const hal::TimeNs last_ns = kSecond_ns + 1'000'000;
  EXPECT_DOUBLE_EQ(velocity.at(last_ns), 1000.0);
  EXPECT_DOUBLE_EQ(velocity.at(last_ns + 1'000'000), 1000.0);
  EXPECT_DOUBLE_EQ(velocity.at(last_ns + 4'000'000), 250.0);
  EXPECT_DOUBLE_EQ(velocity.at(last_ns + 100'000'000), 10.0);
  EXPECT_EQ(velocity.at(last_ns + CountVelocity::kStandstill_ns), 0.0);
}

TEST(CountVelocity, TremblingOnOneEdgeIsNoVelocity) {
  CountVelocity velocity(0);
  for (hal::TimeNs i = 0; i < 20; ++i) {
    velocity.saw(7, kSecond_ns + i * 10'000);
    EXPECT_EQ(velocity.at(kSecond_ns + i * 10'000), 0.0);
  }
}

TEST(CountVelocity, EdgesAtTheSameInstantGiveNoInfinity) {
  CountVelocity velocity(0);
  velocity.saw(1, kSecond_ns);
  velocity.saw(3, kSecond_ns);
  EXPECT_EQ(velocity.at(kSecond_ns), 0.0);
}

// A slow sine, sampled at 1 kHz. The estimate is a mean over at most two counts, and the velocity
// changes most over two counts where it comes from rest: by sqrt(2 * 2 counts * acceleration).
TEST(CountVelocity, FollowsASineWithinTheResolutionOfItsEdges) {
  CountVelocity velocity(kWindow_ns);
  const auto position = [](double time_s) { return 40.0 * std::sin(3.0 * time_s); };
  double last = position(0.0);
  double worst = 0.0;
  for (int us = 1; us < 4'000'000; us += 10) {
    const double now = position(1e-6 * us);
    if (std::floor(now) != std::floor(last)) {
      const auto lower = static_cast<std::int64_t>(std::floor(std::max(now, last)));
      velocity.saw(2 * lower - 1, kSecond_ns + us * hal::TimeNs{1000});
    }
    last = now;
    const double truth = 120.0 * std::cos(3e-6 * us);
    if (us % 1000 == 1 && us > 200'000) {
      worst = std::max(worst, std::abs(velocity.at(kSecond_ns + us * hal::TimeNs{1000}) - truth));
    }
  }
  EXPECT_LT(worst, std::sqrt(4.0 * 40.0 * 3.0 * 3.0));
}

}  // namespace
}  // namespace tactus::drivers
