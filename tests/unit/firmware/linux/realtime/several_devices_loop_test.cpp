// The loop with two devices.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "firmware/linux/tactusd/loop.h"
#include "firmware/safety/faults.h"
#include "hal/simulated/gpio_chip.h"
#include "hal/simulated/gpio_lines.h"
#include "tests/unit/firmware/linux/realtime/scripted_loop.h"

namespace tactus::firmware {
namespace {

// The line of each device's watchdog.
constexpr std::array<std::uint32_t, 2> kLines{3, 5};
constexpr std::size_t kFaultAt = 20;

class RunLoopOfTwo : public ::testing::Test {
 protected:
  void configure(OnFault on_fault) {
    ControllerConfig config = cartesian_config();
    config.on_fault = on_fault;
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(controller_->configure(config, i));
      devices_[i].next.position = {0.01 * static_cast<double>(i), 0.02, 0.03};
      ASSERT_TRUE(watchdogs_[i].open(
          lines_[i], {.offset = kLines[i], .direction = hal::GpioDirection::output}));
    }
  }

  template <class Hooks>
  LoopEnd run(const LoopConfig& config, Hooks& hooks) {
    timing_.set_period(config.phase.period_ns);
    const std::array devices{&devices_.front(), &devices_.back()};
    const std::array watchdogs{&watchdogs_.front(), &watchdogs_.back()};
    return run_loop(
        config,
        {.controller = *controller_, .clock = clock_, .timing = timing_, .watchdogs = watchdogs},
        std::span(devices), hooks);
  }

  // Runs thirty ticks with a fault of the second drive. Returns each line's level before each tick.
  std::vector<std::array<bool, 2>> levels_around_a_fault() {
    std::vector<std::array<bool, 2>> levels;
    testing::EnablingHooks open([&](std::size_t tick) {
      levels.push_back({chip_.level(kLines[0]), chip_.level(kLines[1])});
      devices_[1].next.status = tick == kFaultAt ? drivers::kDeviceDriveFault : drivers::kDeviceOk;
    });
    EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 30}, open), LoopEnd::faulted);
    return levels;
  }

  hal::SimulatedClock clock_{1'000'000'123};
  hal::SimulatedGpioChip chip_{clock_};
  std::array<hal::SimulatedGpioLines, 2> lines_{hal::SimulatedGpioLines(chip_),
                                                hal::SimulatedGpioLines(chip_)};
  std::array<testing::SlowDevice, 2> devices_{testing::SlowDevice(clock_),
                                              testing::SlowDevice(clock_)};
  std::unique_ptr<ControllerOf<2>> controller_ = std::make_unique<ControllerOf<2>>();
  LoopTiming timing_;
  std::array<WatchdogOutput, 2> watchdogs_;
};

TEST_F(RunLoopOfTwo, ReadsAndWritesBothInOneTick) {
  configure(OnFault::all);
  testing::EnablingHooks open([](std::size_t) {});
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 50}, open), LoopEnd::ended);
  ASSERT_EQ(open.seen.size(), 50U);
  // Two transfers of each device.
  EXPECT_EQ(open.seen.back().loop.done_ns - open.seen.back().loop.woke_ns, 240'000);
  EXPECT_EQ(controller_->mode(0), Mode::active);
  EXPECT_EQ(controller_->mode(1), Mode::active);
}

TEST_F(RunLoopOfTwo, AFaultOfOneTakesThePowerAndTheWatchdogOfBoth) {
  configure(OnFault::all);
  const auto levels = levels_around_a_fault();
  for (std::size_t i = 1; i < levels.size(); ++i) {
    for (std::size_t device = 0; device < 2; ++device) {
      EXPECT_EQ(levels[i][device] != levels[i - 1][device], i <= kFaultAt) << i << " " << device;
    }
  }
  EXPECT_FALSE(devices_[0].powered);
  EXPECT_FALSE(devices_[1].powered);
  EXPECT_EQ(controller_->record(0).faults, kFaultOtherDevice);
}

TEST_F(RunLoopOfTwo, AFaultOfItsOwnLeavesTheOtherItsPowerAndItsWatchdog) {
  configure(OnFault::own);
  const auto levels = levels_around_a_fault();
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_NE(levels[i][0], levels[i - 1][0]) << i;
    EXPECT_EQ(levels[i][1] != levels[i - 1][1], i <= kFaultAt) << i;
  }
  EXPECT_TRUE(devices_[0].powered);
  EXPECT_FALSE(devices_[1].powered);
}

TEST_F(RunLoopOfTwo, EndsWhenTheLastHasBeenDisabled) {
  configure(OnFault::all);
  testing::EnablingHooks open([](std::size_t) {});
  open.stop_at = 20;
  EXPECT_EQ(run({.phase = loop_phase(1000.0)}, open), LoopEnd::ended);
  ASSERT_EQ(open.seen.size(), 21U);
  EXPECT_EQ(controller_->mode(0), Mode::ready);
  EXPECT_EQ(controller_->mode(1), Mode::ready);
  EXPECT_FALSE(devices_[0].powered);
  EXPECT_FALSE(devices_[1].powered);
}

// A watchdog's line that cannot be driven is a fault of the loop, which all devices share.
TEST_F(RunLoopOfTwo, AWatchdogThatCannotBeDrivenIsAFaultOfBoth) {
  configure(OnFault::own);
  testing::EnablingHooks open([this](std::size_t tick) {
    if (tick == kFaultAt) {
      chip_.remove();
    }
  });
  EXPECT_EQ(run({.phase = loop_phase(1000.0), .ticks = 30}, open), LoopEnd::faulted);
  EXPECT_NE(controller_->record(0).faults & kFaultWatchdog, 0U);
  EXPECT_NE(controller_->record(1).faults & kFaultWatchdog, 0U);
}

}  // namespace
}  // namespace tactus::firmware
