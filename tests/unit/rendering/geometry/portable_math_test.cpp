// The portable functions against the C library's in long double.
#include "rendering/geometry/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

constexpr std::uint64_t kPortableMathSeed = 20260318;
const int kPoints = testing::share_of(200'000);
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(PortableMath, SineAndCosineAreWithinFourTenthsOfARoundingAtAnyAllowedAngle) {
  SCOPED_TRACE(kPortableMathSeed);
  std::mt19937_64 random(kPortableMathSeed);
  for (const double range : {1.0, 10.0, 1000.0, kLargestAngle}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int i = 0; i < kPoints; ++i) {
      const double x = angle(random);
      const SineCosine result = sine_cosine(x);
      ASSERT_NEAR(result.sine, static_cast<double>(std::sin(static_cast<long double>(x))), 4e-16);
      ASSERT_NEAR(result.cosine, static_cast<double>(std::cos(static_cast<long double>(x))), 4e-16);
    }
  }
}

TEST(PortableMath, SineOfWhatIsNoAngleIsNoNumber) {
  for (const double x : {2.0 * kLargestAngle, kInfinity, -kInfinity, kNaN}) {
    EXPECT_TRUE(std::isnan(sine_cosine(x).sine)) << x;
    EXPECT_TRUE(std::isnan(sine_cosine(x).cosine)) << x;
  }
}

TEST(PortableMath, TheExponentialIsWithinItsRelativeError) {
  SCOPED_TRACE(kPortableMathSeed);
  std::mt19937_64 random(kPortableMathSeed);
  for (const double range : {0.01, 1.0, 30.0, kLargestExponent}) {
    std::uniform_real_distribution<double> exponent(-range, range);
    for (int i = 0; i < kPoints; ++i) {
      const double x = exponent(random);
      const long double exact = std::exp(static_cast<long double>(x));
      ASSERT_LE(std::abs(static_cast<long double>(exponential(x)) / exact - 1.0L), 1e-15L) << x;
    }
  }
}

TEST(PortableMath, TheExponentialStaysFiniteAndAboveZero) {
  EXPECT_EQ(exponential(kInfinity), exponential(kLargestExponent));
  EXPECT_EQ(exponential(-kInfinity), exponential(-kLargestExponent));
  EXPECT_GT(exponential(-kInfinity), 0.0);
  EXPECT_TRUE(std::isfinite(exponential(1e300)));
  EXPECT_TRUE(std::isnan(exponential(kNaN)));
}

TEST(PortableMath, TheLogarithmIsWithinItsErrorFromTheSmallestToTheLargestNumber) {
  SCOPED_TRACE(kPortableMathSeed);
  std::mt19937_64 random(kPortableMathSeed);
  for (const double range : {0.01, 1.0, 30.0, 700.0}) {
    std::uniform_real_distribution<double> exponent(-range, range);
    for (int i = 0; i < kPoints; ++i) {
      const double x = std::exp(exponent(random));
      const long double exact = std::log(static_cast<long double>(x));
      ASSERT_LE(std::abs(static_cast<long double>(logarithm(x)) - exact),
                1e-15L * std::abs(exact) + 1e-16L)
          << x;
    }
  }
}

TEST(PortableMath, TheLogarithmOfZeroAndBelowIsThatOfTheSmallestNumber) {
  EXPECT_NEAR(logarithm(0.0), -708.396, 1e-3);
  EXPECT_EQ(logarithm(-1.0), logarithm(0.0));
  EXPECT_EQ(logarithm(-kInfinity), logarithm(0.0));
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(logarithm(kNaN)));
  EXPECT_EQ(logarithm(1.0), 0.0);
}

// The cube of the root is the argument again.
TEST(PortableMath, TheCubeRootIsTheOneWhoseCubeIsTheArgument) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    const auto root = static_cast<long double>(cube_root(x));
    EXPECT_NEAR(static_cast<double>(root * root * root / static_cast<long double>(x)), 1.0, 3e-15)
        << x;
  }
  EXPECT_EQ(cube_root(27.0), 3.0);
  EXPECT_EQ(cube_root(0.0), 0.0);
  EXPECT_EQ(cube_root(-1.0), 0.0);
  EXPECT_EQ(cube_root(kInfinity), 0.0);
  EXPECT_EQ(cube_root(kNaN), 0.0);
}

}  // namespace
}  // namespace tactus::rendering
