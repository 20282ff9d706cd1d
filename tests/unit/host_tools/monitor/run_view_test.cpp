#include "host_tools/monitor/run_view.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "tests/unit/host_tools/monitor/example_run.h"

namespace tactus::host {
namespace {

TEST(RunView, KnowsNothingBeforeTheFirstTick) {
  const RunView view;
  EXPECT_FALSE(view.newest());
  EXPECT_EQ(view.rate_hz(), 0.0);
}

TEST(RunView, TakesTheRateFromTheTimesAtWhichTicksWereDue) {
  RunView view;
  view.take(example_tick(10, 1));
  EXPECT_EQ(view.rate_hz(), 0.0);
  view.take(example_tick(30, 1));
  EXPECT_DOUBLE_EQ(view.rate_hz(), 1000.0);
  EXPECT_EQ(view.missing(), 19U);
}

TEST(RunView, BeginsAnewWithAnotherRun) {
  RunView view;
  view.take(example_tick(1000, 1));
  view.lose();
  EXPECT_TRUE(view.lost());
  view.take(example_tick(1, 1));
  EXPECT_FALSE(view.lost());
  EXPECT_EQ(view.missing(), 0U);
  EXPECT_EQ(view.rate_hz(), 0.0);
}

TEST(RunView, CountsHowLateTheLoopWoke) {
  const RunView view = example_run();
  EXPECT_EQ(view.wake_up().count(), 100U);
  EXPECT_EQ(view.wake_up().bins()[3], 98U);
  EXPECT_EQ(view.wake_up().bins()[60], 1U);
  EXPECT_EQ(view.wake_up().overflow(), 1U);
  EXPECT_EQ(view.tick_time().bins()[80], 100U);
}

TEST(RunView, CountsLateTicksThatTheControllerDoesNotCount) {
  RunView view;
  const auto take = [&](std::uint64_t number, std::int64_t latency_ns, std::uint32_t counted) {
    firmware::RecordedTick tick = example_tick(number, 1);
    tick.loop.woke_ns = tick.loop.scheduled_ns + latency_ns;
    tick.record.counters.late_ticks = counted;
    view.take(tick);
  };
  take(1, 0, 0);
  take(2, 499'000, 0);
  EXPECT_EQ(view.late_ticks(), 0U);
  take(3, 501'000, 0);
  // Ten periods have passed between these two.
  take(13, 499'000, 0);
  take(23, 501'000, 0);
  EXPECT_EQ(view.late_ticks(), 2U);
  take(24, 0, 7);
  EXPECT_EQ(view.late_ticks(), 7U) << "the controller has seen those that were not published, too";
  take(1, 0, 0);
  EXPECT_EQ(view.late_ticks(), 0U) << "another run";
}

TEST(RunView, ASimulationHasNoWakeUps) {
  RunView view;
  firmware::RecordedTick tick = example_tick(1, 0);
  tick.loop.woke_ns = 0;
  view.take(tick);
  EXPECT_EQ(view.wake_up().count(), 0U);
}

TEST(RunView, TheScaleOfTheForceGrowsInRoundSteps) {
  RunView view;
  EXPECT_EQ(view.force_scale_N(), 1.0);
  const auto scale_after = [&](double force_N) {
    firmware::RecordedTick tick = example_tick(1, 1);
    tick.record.force_commanded_W = {force_N, 0.0, 0.0};
    view.take(tick);
    return view.force_scale_N();
  };
  EXPECT_DOUBLE_EQ(scale_after(1.0), 1.0);
  EXPECT_DOUBLE_EQ(scale_after(1.1), 2.0);
  EXPECT_DOUBLE_EQ(scale_after(4.0), 5.0);
  EXPECT_DOUBLE_EQ(scale_after(18.0), 20.0);
  EXPECT_DOUBLE_EQ(scale_after(std::numeric_limits<double>::infinity()), 20.0);
  EXPECT_DOUBLE_EQ(scale_after(std::numeric_limits<double>::quiet_NaN()), 20.0);
}

}  // namespace
}  // namespace tactus::host
