#include "firmware/linux/realtime/time_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace tactus::firmware {
namespace {

TEST(TimeHistogram, IsAllZeroWhileEmpty) {
  const TimeHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.min_ns(), 0);
  EXPECT_EQ(histogram.max_ns(), 0);
  EXPECT_EQ(histogram.mean_ns(), 0.0);
  EXPECT_EQ(histogram.percentile_us(0.5), 0.0);
}

TEST(TimeHistogram, PutsATimeIntoTheBinOfItsMicrosecond) {
  TimeHistogram histogram;
  for (const std::int64_t time_ns : {0, 999, 1000, 7'500, 999'999, 1'000'000, 5'000'000}) {
    histogram.add(time_ns);
  }
  EXPECT_EQ(histogram.bins()[0], 2U);
  EXPECT_EQ(histogram.bins()[1], 1U);
  EXPECT_EQ(histogram.bins()[7], 1U);
  EXPECT_EQ(histogram.bins()[999], 1U);
  EXPECT_EQ(histogram.overflow(), 2U);
  EXPECT_EQ(histogram.max_ns(), 5'000'000);
}

TEST(TimeHistogram, CountsATimeBelowZeroAsZero) {
  TimeHistogram histogram;
  histogram.add(-50);
  EXPECT_EQ(histogram.bins()[0], 1U);
  EXPECT_EQ(histogram.min_ns(), 0);
}

TEST(TimeHistogram, AgreesWithASortedListOfTheTimes) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::lognormal_distribution<double> some_us(3.0, 1.0);
  TimeHistogram histogram;
  std::vector<std::int64_t> times_ns;
  double sum_ns = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    times_ns.push_back(static_cast<std::int64_t>(1e3 * some_us(random)));
    histogram.add(times_ns.back());
    sum_ns += static_cast<double>(times_ns.back());
  }
  std::ranges::sort(times_ns);
  EXPECT_EQ(histogram.min_ns(), times_ns.front());
  EXPECT_EQ(histogram.max_ns(), times_ns.back());
  EXPECT_NEAR(histogram.mean_ns(), sum_ns / 20'000.0, 1e-6);
  for (const double share : {0.01, 0.5, 0.9, 0.99}) {
    const auto nth = static_cast<std::size_t>(std::ceil(share * 20'000.0)) - 1;
    const double exact_us = 1e-3 * static_cast<double>(times_ns[nth]);
    EXPECT_GE(histogram.percentile_us(share), exact_us);
    EXPECT_LE(histogram.percentile_us(share), exact_us + 1.0);
  }
}

TEST(TimeHistogram, GivesTheLongestTimeForAShareInTheOverflow) {
  TimeHistogram histogram;
  histogram.add(5'000);
  histogram.add(2'345'000);
  EXPECT_EQ(histogram.percentile_us(1.0), 2345.0);
}

}  // namespace
}  // namespace tactus::firmware
