#include "firmware/linux/realtime/loop_timing.h"

#include <gtest/gtest.h>

namespace tactus::firmware {
namespace {

constexpr hal::TimeNs kPeriod_ns = 250'000;

hal::Wake woken(hal::TimeNs latency_ns, std::int64_t skipped = 0) {
  return {.scheduled_ns = 1'000'000, .woke_ns = 1'000'000 + latency_ns, .skipped = skipped};
}

TEST(LoopTiming, CallsATickLateFromHalfAPeriodOn) {
  LoopTiming timing;
  timing.set_period(kPeriod_ns);
  EXPECT_FALSE(timing.woke(woken(7'000)).late);
  EXPECT_FALSE(timing.woke(woken(kPeriod_ns / 2)).late);
  EXPECT_TRUE(timing.woke(woken(kPeriod_ns / 2 + 1)).late);
  EXPECT_EQ(timing.late(), 1U);
  EXPECT_EQ(timing.missed(), 0U);
}

TEST(LoopTiming, CallsATickAfterMissedOnesLateAndCountsThem) {
  LoopTiming timing;
  timing.set_period(kPeriod_ns);
  const LoopTick tick = timing.woke(woken(7'000, 3));
  EXPECT_TRUE(tick.late);
  EXPECT_EQ(tick.skipped, 3);
  EXPECT_EQ(timing.missed(), 3U);
  EXPECT_EQ(timing.late(), 1U);
}

TEST(LoopTiming, KeepsAHistogramOfTheWakeUpTheTickAndEveryStage) {
  LoopTiming timing;
  timing.set_period(kPeriod_ns);
  LoopTick tick = timing.woke(woken(7'200));
  const StageTimes stages{.read = 20'000,
                          .check = 1'000,
                          .kinematics = 2'000,
                          .touch = 3'000,
                          .safety = 4'000,
                          .write = 5'000};
  timing.done(tick, stages, tick.woke_ns + 40'000);
  EXPECT_EQ(tick.done_ns, 1'047'200);
  EXPECT_EQ(timing.of(Timed::wake_up).bins()[7], 1U);
  EXPECT_EQ(timing.of(Timed::tick).bins()[40], 1U);
  EXPECT_EQ(timing.of(Timed::read).bins()[20], 1U);
  EXPECT_EQ(timing.of(Timed::check).bins()[1], 1U);
  EXPECT_EQ(timing.of(Timed::kinematics).bins()[2], 1U);
  EXPECT_EQ(timing.of(Timed::touch).bins()[3], 1U);
  EXPECT_EQ(timing.of(Timed::safety).bins()[4], 1U);
  EXPECT_EQ(timing.of(Timed::write).bins()[5], 1U);
}

}  // namespace
}  // namespace tactus::firmware
