// Interval arithmetic against operations on single numbers, and sine and cosine of intervals
// against long double. The operations on intervals act on both ends at once; here each end is
// computed alone.
#include "rendering/surface/interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "rendering/surface/elementary.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

constexpr std::uint64_t kIntervalSeed = 20261127;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();

// Numbers of every size, zeros, and the ends of the range of a double.
double any_end(std::mt19937_64& random) {
  constexpr auto kSpecial =
      std::to_array({0.0, -0.0, 1.0, -1.0, 0x1p-1074, -0x1p-1074, 0x1p-1022, kLargest, -kLargest});
  std::uniform_real_distribution<double> mantissa(-2.0, 2.0);
  const int kind = static_cast<int>(random() % 8U);
  if (kind == 0) {
    return kSpecial.at(static_cast<std::size_t>(random() % kSpecial.size()));
  }
  const int exponent =
      kind == 1 ? static_cast<int>(random() % 2000U) - 1000 : static_cast<int>(random() % 8U) - 4;
  return std::ldexp(mantissa(random), exponent);
}

Interval any_interval(std::mt19937_64& random) {
  const double one = any_end(random);
  const double other = random() % 8U == 0 ? one : any_end(random);
  const double lower = random() % 16U == 0 ? -kUnbounded : std::min(one, other);
  return {lower, random() % 16U == 0 ? kUnbounded : std::max(one, other)};
}

// Expects `result` to hold the least and the largest of an exact operation and to be no wider than
// two roundings make it. Neither end goes to the other side of 0.
void expect_hull(const Interval& result, double least, double largest) {
  constexpr double kRoundings = 2.0 * 0x1p-52;
  constexpr double kSmallest = 2.0 * std::numeric_limits<double>::min();
  const auto slack = [](double end) { return kRoundings * std::abs(end) + kSmallest; };
  ASSERT_LE(result.lower(), least);
  ASSERT_GE(result.upper(), largest);
  if (std::isfinite(least)) {
    ASSERT_GE(result.lower(), least - slack(least));
  }
  if (std::isfinite(largest)) {
    ASSERT_LE(result.upper(), largest + slack(largest));
  }
  ASSERT_TRUE(least < 0.0 || result.lower() >= 0.0) << least;
  ASSERT_TRUE(largest > 0.0 || result.upper() <= 0.0) << largest;
}

TEST(IntervalArithmetic, GivesTheHullOfTheOperationOnTheEnds) {
  SCOPED_TRACE(kIntervalSeed);
  std::mt19937_64 random(kIntervalSeed);
  const int runs = testing::share_of(300'000);
  for (int run = 0; run < runs; ++run) {
    const Interval a = any_interval(random);
    const Interval b = any_interval(random);
    const double c = any_end(random);
    SCOPED_TRACE(::testing::Message() << "[" << a.lower() << ", " << a.upper() << "] [" << b.lower()
                                      << ", " << b.upper() << "] " << c);
    expect_hull(a + b, a.lower() + b.lower(), a.upper() + b.upper());
    expect_hull(a - b, a.lower() - b.upper(), a.upper() - b.lower());
    expect_hull(-a, -a.upper(), -a.lower());
    expect_hull(a + c, a.lower() + c, a.upper() + c);
    const auto products = std::to_array({a.lower() * b.lower(), a.lower() * b.upper(),
                                         a.upper() * b.lower(), a.upper() * b.upper()});
    const auto [least, largest] = std::ranges::minmax(products);
    if (std::ranges::none_of(products, [](double p) { return std::isnan(p); })) {
      expect_hull(a * b, least, largest);
    } else {
      // Zero times infinity: every number is possible.
      ASSERT_EQ((a * b).lower(), -kUnbounded);
      ASSERT_EQ((a * b).upper(), kUnbounded);
    }
    const double at_lower = a.lower() * c;
    const double at_upper = a.upper() * c;
    if (!std::isnan(at_lower) && !std::isnan(at_upper)) {
      expect_hull(a * c, std::min(at_lower, at_upper), std::max(at_lower, at_upper));
    }
    if (::testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

TEST(IntervalArithmetic, HoldsThePowersOfTheNumbersInIt) {
  SCOPED_TRACE(kIntervalSeed);
  std::mt19937_64 random(kIntervalSeed);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  const int runs = testing::share_of(20'000);
  for (int run = 0; run < runs; ++run) {
    const double one = number(random);
    const double other = number(random);
    const Interval a{std::min(one, other), std::max(one, other)};
    for (const int n : {1, 2, 3, 4, 5, 7, 8, 64}) {
      const Interval range = power(a, n);
      const double at_lower = std::pow(a.lower(), n);
      const double at_upper = std::pow(a.upper(), n);
      const bool turns = n % 2 == 0 && a.lower() < 0.0 && a.upper() > 0.0;
      const double least = turns ? 0.0 : std::min(at_lower, at_upper);
      const double largest = std::max(at_lower, at_upper);
      const double slack = 4.0 * n * 0x1p-52;
      ASSERT_LE(range.lower(), least);
      ASSERT_GE(range.upper(), largest);
      ASSERT_GE(range.lower(), least - slack * std::abs(least) - 1e-300);
      ASSERT_LE(range.upper(), largest + slack * std::abs(largest) + 1e-300);
    }
  }
}

// Expects an interval to hold the least and the largest value of a function on a fine grid, and to
// be wider by `most_slack` at most on either side.
template <class Function>
void expect_range(const Interval& range, const Interval& a, double most_slack,
                  const Function& function) {
  constexpr int kSamples = 64;
  long double least = 2.0L;
  long double largest = -2.0L;
  for (int k = 0; k <= kSamples; ++k) {
    const long double share = static_cast<long double>(k) / kSamples;
    const auto lower = static_cast<long double>(a.lower());
    const auto width = static_cast<long double>(a.upper() - a.lower());
    const long double value = function(lower + share * width);
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  const auto lower = static_cast<long double>(range.lower());
  const auto upper = static_cast<long double>(range.upper());
  const auto slack = static_cast<long double>(most_slack);
  ASSERT_LE(lower, least);
  ASSERT_GE(upper, largest);
  ASSERT_GE(lower, least - slack);
  ASSERT_LE(upper, largest + slack);
  ASSERT_GE(range.lower(), -1.0);
  ASSERT_LE(range.upper(), 1.0);
}

// Angles of every width and about every turning point, on both sides of the width up to which the
// values at the middle serve.
TEST(IntervalSine, HoldsTheSineAndTheCosineAndIsAsNarrowAsTheAngle) {
  SCOPED_TRACE(kIntervalSeed);
  std::mt19937_64 random(kIntervalSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr long double kQuarter = 1.57079632679489661923132169163975144L;
  const int runs = testing::share_of(20'000);
  for (int run = 0; run < runs; ++run) {
    const double size = run % 2 == 0 ? 10.0 : kLargestAngle - 10.0;
    const double at =
        run % 3 == 0
            ? static_cast<double>(kQuarter *
                                  static_cast<long double>(std::round(0.5 * size * unit(random))))
            : size * unit(random);
    const double width = std::pow(10.0, -8.0 + 4.0 * (1.0 + unit(random)));
    const double from = at - std::abs(unit(random)) * width;
    const Interval a{from, from + width};
    SCOPED_TRACE(::testing::Message() << "[" << a.lower() << ", " << a.upper() << "]");
    const SineAndCosine<Interval> both_of = sine_and_cosine(a);
    // The bend, which is its square, and the roundings of the angle.
    const double slack = 1e-14 + 0x1p-50 * std::abs(from) + 0.5 * width * width;
    expect_range(both_of.sine, a, slack, [](long double x) { return std::sin(x); });
    expect_range(both_of.cosine, a, slack, [](long double x) { return std::cos(x); });
    // The numbers' own functions are in it too.
    const SineCosine middle = sine_cosine(from + 0.5 * width);
    ASSERT_TRUE(contains(both_of.sine, middle.sine));
    ASSERT_TRUE(contains(both_of.cosine, middle.cosine));
    ASSERT_TRUE(contains(sine(a), middle.sine));
    ASSERT_TRUE(contains(cosine(a), middle.cosine));
    if (::testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

TEST(IntervalSine, IsEverythingBeyondTheLargestAngle) {
  for (const Interval a : {Interval{2.0 * kLargestAngle, 2.0 * kLargestAngle + 1e-3},
                           Interval{kLargestAngle - 1e-3, kLargestAngle + 1e-4},
                           Interval{-kLargestAngle - 1e-4, -kLargestAngle + 1e-3},
                           Interval{0.0, kUnbounded}, kEverything}) {
    EXPECT_EQ(sine(a).upper(), kUnbounded);
    EXPECT_EQ(cosine(a).lower(), -kUnbounded);
  }
}

}  // namespace
}  // namespace tactus::rendering
