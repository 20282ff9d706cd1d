#include "firmware/linux/tactusd/loop.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"
#include "hal/simulated/gpio_chip.h"
#include "hal/simulated/gpio_lines.h"
#include "tests/unit/firmware/linux/realtime/scripted_loop.h"

namespace tactus::firmware {
namespace {

constexpr hal::TimeNs kMillisecond_ns = 1'000'000;
constexpr std::uint32_t kWatchdogLine = 3;

class RunLoop : public ::testing::Test {
 protected:
  RunLoop() {
    EXPECT_TRUE(controller_.configure(cartesian_config()));
    device_.next.position = {0.01, 0.02, 0.03};
    EXPECT_TRUE(
        watchdog_.open(lines_, {.offset = kWatchdogLine, .direction = hal::GpioDirection::output}));
  }

  template <class Hooks>
  LoopEnd run(const LoopConfig& config, Hooks& hooks) {
    timing_.set_period(config.phase.period_ns);
    const std::array devices{&device_};
    const std::array watchdogs{&watchdog_};
    return run_loop(
        config,
        {.controller = controller_, .clock = clock_, .timing = timing_, .watchdogs = watchdogs},
        std::span(devices), hooks);
  }
  auto hooks() {
    return testing::EnablingHooks([](std::size_t) {});
  }

  hal::SimulatedClock clock_{1'000'000'123};
  hal::SimulatedGpioChip chip_{clock_};
  hal::SimulatedGpioLines lines_{chip_};
  testing::SlowDevice device_{clock_};
  Controller controller_;
  LoopTiming timing_;
  WatchdogOutput watchdog_;
};

TEST_F(RunLoop, TicksOnThePhaseAndPublishesEveryTick) {
  auto open = hooks();
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 50}, open), LoopEnd::ended);
  ASSERT_EQ(open.seen.size(), 50U);
  for (std::size_t i = 0; i < open.seen.size(); ++i) {
    EXPECT_EQ(open.seen[i].tick, i);
    EXPECT_EQ(open.seen[i].loop.scheduled_ns,
              1'001'000'000 + static_cast<hal::TimeNs>(i) * kMillisecond_ns);
    EXPECT_EQ(open.seen[i].loop.done_ns - open.seen[i].loop.woke_ns, 120'000);
  }
  EXPECT_EQ(open.seen.back().mode, Mode::active);
  EXPECT_EQ(timing_.missed(), 0U);
}

TEST_F(RunLoop, TakesEveryRateFromOneToEightKilohertz) {
  for (const double rate_hz : {1000.0, 2000.0, 4000.0, 8000.0}) {
    auto open = hooks();
    device_.read_ns = 50'000;
    const hal::TimeNs before_ns = clock_.now_ns();
    run({.phase = loop_phase(rate_hz), .ticks = 800}, open);
    EXPECT_NEAR(static_cast<double>(clock_.now_ns() - before_ns), 800.0 * 1e9 / rate_hz, 1e6);
  }
  EXPECT_EQ(timing_.missed(), 0U);
}

TEST_F(RunLoop, LosesTicksButNotItsPhaseWhenATransferTakesTooLong) {
  testing::EnablingHooks open(
      [this](std::size_t tick) { device_.read_ns = tick == 20 ? 2'500'000 : 100'000; });
  run({.phase = loop_phase(1000.0), .ticks = 30}, open);
  EXPECT_EQ(timing_.missed(), 2U);
  EXPECT_EQ(timing_.late(), 1U);
  EXPECT_TRUE(open.seen[21].loop.late);
  EXPECT_EQ(open.seen[21].loop.skipped, 2);
  for (const testing::SeenTick& seen : open.seen) {
    EXPECT_EQ(seen.loop.scheduled_ns % kMillisecond_ns, 0);
  }
}

TEST_F(RunLoop, DisablesBeforeItEndsWhenToldToStop) {
  auto open = hooks();
  open.stop_at = 20;
  EXPECT_EQ(run({.phase = loop_phase(1000.0)}, open), LoopEnd::ended);
  ASSERT_EQ(open.seen.size(), 21U);
  EXPECT_EQ(open.seen[19].mode, Mode::active);
  EXPECT_EQ(open.seen[20].mode, Mode::ready);
  EXPECT_FALSE(device_.powered);
}

// Is told to stop in the very tick that gives the motors power.
class StopsAsItEnables : public testing::EnablingHooks<void (*)(std::size_t)> {
 public:
  explicit StopsAsItEnables(const Controller& controller)
      : EnablingHooks([](std::size_t) {}), controller_(controller) {}

  [[nodiscard]] bool stopping() const { return controller_.mode() == Mode::ready; }

 private:
  const Controller& controller_;
};

TEST_F(RunLoop, ToldToStopInTheTickThatEnablesItDisablesInTheNext) {
  StopsAsItEnables open(controller_);
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 500}, open), LoopEnd::ended);
  ASSERT_GE(open.seen.size(), 2U);
  ASSERT_LT(open.seen.size(), 500U);
  EXPECT_EQ(open.seen[open.seen.size() - 2].mode, Mode::active);
  EXPECT_EQ(open.seen.back().mode, Mode::ready);
  EXPECT_FALSE(device_.powered);
}

TEST_F(RunLoop, GoesOnWithoutPowerAfterAFaultAndSaysSoAtItsEnd) {
  testing::EnablingHooks open([this](std::size_t tick) {
    device_.next.status = tick == 20 ? drivers::kDeviceDriveFault : drivers::kDeviceOk;
  });
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 500}, open), LoopEnd::faulted);
  EXPECT_EQ(open.seen.size(), 500U);
  EXPECT_EQ(open.seen[20].mode, Mode::fault);
  EXPECT_FALSE(device_.powered);
}

TEST_F(RunLoop, GivesTheWatchdogAnEdgeForEachHealthyTickAndNoneInFault) {
  std::vector<bool> levels;
  testing::EnablingHooks open([&](std::size_t tick) {
    levels.push_back(chip_.level(kWatchdogLine));
    device_.next.status = tick == 20 ? drivers::kDeviceDriveFault : drivers::kDeviceOk;
  });
  run({.phase = loop_phase(1000.0), .ticks = 31}, open);
  // levels[i] is what the ticks before i left.
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i] != levels[i - 1], i <= 20) << i;
  }
}

TEST_F(RunLoop, TellsTheControllerOfThreeLateTicksInARowWhichIsAFault) {
  for (const std::size_t late : {2U, 3U}) {
    ASSERT_TRUE(controller_.configure(cartesian_config()));
    // Each takes longer than the period, so the one after it is late.
    testing::EnablingHooks open([&](std::size_t tick) {
      device_.read_ns = tick >= 20 && tick < 20 + late ? 1'100'000 : 100'000;
    });
    const LoopEnd end = run({.phase = loop_phase(1000.0), .ticks = 60}, open);
    EXPECT_EQ(end, late < 3 ? LoopEnd::ended : LoopEnd::faulted) << late;
    EXPECT_EQ(open.seen[23].mode, late < 3 ? Mode::active : Mode::fault) << late;
    EXPECT_EQ((controller_.record().faults & kFaultLateTicks) != 0, late >= 3) << late;
  }
}

TEST_F(RunLoop, TellsTheControllerThatTheWatchdogCannotBeDriven) {
  testing::EnablingHooks open([this](std::size_t tick) {
    if (tick == 20) {
      chip_.remove();
    }
  });
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 30}, open), LoopEnd::faulted);
  EXPECT_EQ(open.seen[20].mode, Mode::active);
  EXPECT_EQ(open.seen[21].mode, Mode::fault);
  EXPECT_NE(controller_.record().faults & kFaultWatchdog, 0U);
}

TEST_F(RunLoop, TakesThePowerAwayAndEndsInTheTickThatSeesACrashBesideIt) {
  auto open = hooks();
  open.crash_at = 20;
  EXPECT_EQ(run({.phase = loop_phase(1000.0)}, open), LoopEnd::faulted);
  ASSERT_EQ(open.seen.size(), 21U);
  EXPECT_EQ(open.seen[19].mode, Mode::active);
  EXPECT_EQ(open.seen[20].mode, Mode::fault);
  EXPECT_EQ(controller_.record().faults, kFaultHelperCrashed);
  EXPECT_FALSE(device_.powered);
}

TEST_F(RunLoop, TellsTheControllerOfManySkippedTicksAtOnceWhichIsAFault) {
  testing::EnablingHooks open(
      [this](std::size_t tick) { device_.read_ns = tick == 20 ? 20'000'000 : 100'000; });
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 30}, open), LoopEnd::faulted);
  EXPECT_NE(controller_.record().faults & kFaultTickOverrun, 0U);
}

TEST(LoopReportTest, SaysWhatTheTickKnowsOfItself) {
  EXPECT_EQ(loop_report({}, true, false).status, kLoopOnTime);
  EXPECT_EQ(loop_report({.late = true}, true, false).status, kLoopLate);
  EXPECT_EQ(loop_report({}, false, false).status, kLoopWatchdogLost);
  EXPECT_EQ(loop_report({}, true, true).status, kLoopHelperCrashed);
  EXPECT_EQ(loop_report({.skipped = 7}, true, false).missed_ticks, 7U);
}

TEST_F(RunLoop, GivesTheWatchdogNoEdgeForALateTick) {
  std::vector<bool> levels;
  testing::EnablingHooks open([&](std::size_t tick) {
    levels.push_back(chip_.level(kWatchdogLine));
    device_.read_ns = tick == 20 ? 2'500'000 : 100'000;
  });
  run({.phase = loop_phase(1000.0), .ticks = 30}, open);
  EXPECT_EQ(levels[22], levels[21]) << "tick 21 came late";
  EXPECT_NE(levels[23], levels[22]);
}

}  // namespace
}  // namespace tactus::firmware
