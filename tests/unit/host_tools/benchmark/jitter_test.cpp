#include "host_tools/benchmark/jitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The output of cyclictest 2.40, shortened.
constexpr const char* kAnswer =
    R"({"file_version": 1, "num_threads": 1, "thread": {"0": {"histogram": {"14": 1, "17": 8},)"
    R"( "cycles": 10, "min": 14, "max": 5438, "avg": 41.80, "cpu": 0, "node": 0}}})";

TEST(Jitter, ReadsWhatCyclictestWrites) {
  const Jitter jitter = read_cyclictest(kAnswer);
  EXPECT_EQ(jitter.count, 10U);
  EXPECT_EQ(jitter.bins[14], 1U);
  EXPECT_EQ(jitter.bins[17], 8U);
  EXPECT_EQ(jitter.overflow, 1U);
  EXPECT_EQ(jitter.min_us, 14.0);
  EXPECT_EQ(jitter.mean_us, 41.8);
  EXPECT_EQ(jitter.max_us, 5438.0);
}

TEST(Jitter, RefusesWhatCyclictestDoesNotWrite) {
  constexpr const char* kTooLate = R"({"thread": {"0": {"cycles": 1, "min": 1, "max": 1, "avg": 1,)"
                                   R"( "histogram": {"1000": 1}}}})";
  for (const char* text : {"", "{}", "[1]", R"({"thread": {"0": {"cycles": "x"}}})", kTooLate}) {
    EXPECT_THROW(read_cyclictest(text), InputError) << text;
  }
}

TEST(Jitter, PercentilesAreUpperEdgesOfBins) {
  const Jitter jitter = read_cyclictest(kAnswer);
  EXPECT_EQ(percentile_us(jitter, 0.05), 15.0);
  EXPECT_EQ(percentile_us(jitter, 0.5), 18.0);
  EXPECT_EQ(percentile_us(jitter, 0.999), 5438.0);
}

TEST(Jitter, BarsShowEveryBandAndTheOneThatIsLate) {
  const std::string bars = jitter_bars(read_cyclictest(kAnswer), 10);
  EXPECT_EQ(std::count(bars.begin(), bars.end(), '\n'), 10);
  EXPECT_TRUE(bars.contains("    10 to   20 us         9 ##########\n")) << bars;
  EXPECT_TRUE(bars.contains("     longer             1 ###\n")) << bars;
}

TEST(Jitter, TheLoopCountsEveryWakeUp) {
  const Jitter jitter =
      measure_loop({.rate_hz = 1000.0, .seconds = 0.05, .priority = 1, .cpu = {}});
  EXPECT_EQ(jitter.count, 50U);
  EXPECT_EQ(std::accumulate(jitter.bins.begin(), jitter.bins.end(), jitter.overflow), 50U);
  EXPECT_LE(jitter.min_us, jitter.mean_us);
  EXPECT_LE(jitter.mean_us, jitter.max_us);
}

}  // namespace
}  // namespace tactus::host
