// The contract of every Clock. A rig has: Clock& clock().
#pragma once

#include <gtest/gtest.h>

#include "hal/clock.h"

namespace tactus::hal {

template <class Rig>
class ClockContract : public ::testing::Test {
 protected:
  Clock& clock() { return rig_.clock(); }
  Rig rig_;
};

TYPED_TEST_SUITE_P(ClockContract);

TYPED_TEST_P(ClockContract, NeverGoesBack) {
  TimeNs last_ns = this->clock().now_ns();
  for (int i = 0; i < 1000; ++i) {
    const TimeNs now_ns = this->clock().now_ns();
    ASSERT_GE(now_ns, last_ns);
    last_ns = now_ns;
  }
}

TYPED_TEST_P(ClockContract, NeverWakesEarly) {
  const TimeNs wake_ns = this->clock().now_ns() + 1'000'000;
  const Wake wake = this->clock().sleep_until(wake_ns);
  EXPECT_EQ(wake.scheduled_ns, wake_ns);
  EXPECT_GE(wake.woke_ns, wake_ns);
  EXPECT_GE(this->clock().now_ns(), wake.woke_ns);
  EXPECT_EQ(wake.skipped, 0);
}

TYPED_TEST_P(ClockContract, TimeThatHasPassedIsNoSleep) {
  const TimeNs before_ns = this->clock().now_ns();
  const Wake wake = this->clock().sleep_until(before_ns - 1'000'000'000);
  EXPECT_GE(wake.woke_ns, before_ns);
}

TYPED_TEST_P(ClockContract, EveryWakeLiesOnThePhase) {
  const Phase phase{.period_ns = 500'000, .offset_ns = 123'456};
  Wake wake = this->clock().sleep_until(this->clock().now_ns());
  for (int i = 0; i < 20; ++i) {
    const Wake next = this->clock().sleep_to_phase(phase, wake);
    EXPECT_EQ((next.scheduled_ns - phase.offset_ns) % phase.period_ns, 0);
    EXPECT_GT(next.scheduled_ns, wake.scheduled_ns);
    EXPECT_GE(next.woke_ns, next.scheduled_ns);
    if (i > 0) {
      EXPECT_EQ(next.scheduled_ns - wake.scheduled_ns, (next.skipped + 1) * phase.period_ns);
    }
    wake = next;
  }
}

TYPED_TEST_P(ClockContract, OverrunLosesInstantsButNotThePhase) {
  const Phase phase{.period_ns = 1'000'000, .offset_ns = 7};
  const Wake start = this->clock().sleep_to_phase(phase, this->clock().sleep_until(0));
  this->clock().sleep_until(start.scheduled_ns + 3 * phase.period_ns + phase.period_ns / 2);
  const Wake wake = this->clock().sleep_to_phase(phase, start);
  EXPECT_GE(wake.skipped, 3);
  EXPECT_EQ(wake.scheduled_ns, start.scheduled_ns + (wake.skipped + 1) * phase.period_ns);
}

REGISTER_TYPED_TEST_SUITE_P(ClockContract, NeverGoesBack, NeverWakesEarly,
                            TimeThatHasPassedIsNoSleep, EveryWakeLiesOnThePhase,
                            OverrunLosesInstantsButNotThePhase);

}  // namespace tactus::hal
