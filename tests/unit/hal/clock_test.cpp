#include "hal/clock.h"

#include <gtest/gtest.h>

#include "tests/unit/hal/random.h"

namespace tactus::hal {
namespace {

TEST(Phase, NextInstantIsTheFirstLaterOne) {
  const Phase phase{.period_ns = 1000, .offset_ns = 300};
  EXPECT_EQ(next_instant_ns(phase, 0), 300);
  EXPECT_EQ(next_instant_ns(phase, 299), 300);
  EXPECT_EQ(next_instant_ns(phase, 300), 1300);
  EXPECT_EQ(next_instant_ns(phase, 1299), 1300);
  EXPECT_EQ(next_instant_ns(phase, 1300), 2300);
}

TEST(Phase, NextInstantAgreesWithCounting) {
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    const Phase phase{.period_ns = static_cast<TimeNs>(1 + random.below(50)),
                      .offset_ns = static_cast<TimeNs>(random.below(100))};
    const auto after_ns = static_cast<TimeNs>(random.below(1000));
    TimeNs expected_ns = phase.offset_ns;
    while (expected_ns <= after_ns) {
      expected_ns += phase.period_ns;
    }
    ASSERT_EQ(next_instant_ns(phase, after_ns), expected_ns);
  }
}

}  // namespace
}  // namespace tactus::hal
