#include "rendering/effects/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace tactus::rendering {
namespace {

TEST(Phase, SineAgreesWithTheLibrarysInHigherPrecision) {
  if constexpr (std::numeric_limits<long double>::digits == std::numeric_limits<double>::digits) {
    GTEST_SKIP() << "on this processor long double is double";
  }
  constexpr std::uint64_t kSeed = 71;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 100'000; ++i) {
    const Phase phase = random();
    const long double angle =
        2.0L * std::numbers::pi_v<long double> * (static_cast<long double>(phase) * 0x1p-64L);
    ASSERT_NEAR(sine(phase), static_cast<double>(std::sin(angle)), 4e-16) << "seed 71, case " << i;
  }
}

TEST(Phase, SineIsExactAtTheQuarters) {
  EXPECT_EQ(sine(0), 0.0);
  EXPECT_NEAR(sine(Phase{1} << 62U), 1.0, 3e-16);
  EXPECT_EQ(sine(Phase{1} << 63U), 0.0);
  EXPECT_NEAR(sine(Phase{3} << 62U), -1.0, 3e-16);
}

TEST(Phase, AddingAMillionStepsLosesNothing) {
  constexpr double kTurns = 0.05;
  Phase phase = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    phase += phase_of_turns(kTurns);
  }
  // A million times the double next to 0.05, which is 0.05 + 2.8e-18.
  EXPECT_LT(std::abs(static_cast<double>(static_cast<std::int64_t>(phase))) * 0x1p-64, 3e-12);
}

TEST(Phase, WholeTurnsAreDropped) {
  EXPECT_EQ(phase_of_turns(3.25), Phase{1} << 62U);
  EXPECT_EQ(phase_of_turns(-3.75), Phase{1} << 62U);
  EXPECT_EQ(phase_of_turns(0.0), 0U);
  EXPECT_EQ(phase_of_turns(-1e-30), 0U);
}

}  // namespace
}  // namespace tactus::rendering
