#include "firmware/safety/buzz_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tactus::firmware {
namespace {

// The first tick of 1 ms at which a force of half sine waves is a buzz, or -1 within two seconds.
int found_at(double rate_Hz, double peak_N, double kept_a_period = 1.0) {
  BuzzDetector detector;
  detector.configure(0.5);
  for (int tick = 0; tick < 2000; ++tick) {
    const double turns = rate_Hz * 0.001 * tick;
    const double force_N =
        peak_N * std::pow(kept_a_period, turns) * std::max(0.0, std::sin(2.0 * M_PI * turns));
    if (detector.observe(force_N, 0.001)) {
      return tick;
    }
  }
  return -1;
}

TEST(BuzzDetector, FindsABuzzWithinFivePeriods) {
  for (const double rate_Hz : {15.0, 20.0, 50.0, 100.0}) {
    EXPECT_GT(found_at(rate_Hz, 1.0), 4000.0 / rate_Hz) << rate_Hz;
    EXPECT_LT(found_at(rate_Hz, 1.0), 5000.0 / rate_Hz) << rate_Hz;
  }
}

TEST(BuzzDetector, TapsOfAHandAreNone) {
  EXPECT_EQ(found_at(8.0, 10.0), -1);
}

TEST(BuzzDetector, BouncesThatDieAwayAreNone) {
  EXPECT_EQ(found_at(20.0, 10.0, 0.9), -1);
}

TEST(BuzzDetector, WhatIsWeakerThanItsWeakestPeakIsNone) {
  EXPECT_EQ(found_at(20.0, 0.4), -1);
}

TEST(BuzzDetector, AForceThatOnlyRipplesIsNone) {
  BuzzDetector detector;
  detector.configure(0.5);
  for (int tick = 0; tick < 2000; ++tick) {
    EXPECT_FALSE(detector.observe(2.0 + std::sin(0.2 * tick), 0.001));
  }
}

}  // namespace
}  // namespace tactus::firmware
