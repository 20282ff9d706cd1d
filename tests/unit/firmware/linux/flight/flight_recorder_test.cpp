// Every recording of the flight recorder can be replayed, whatever the loop does meanwhile.
#include "firmware/linux/flight/flight_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "firmware/control/repeat_tick.h"
#include "tests/replay/scene_walk.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::firmware {
namespace {

using testing::SceneWalk;
using testing::Solid;

class FlightRecorderTest : public ::testing::Test {
 protected:
  FlightRecorderTest() { take_scene(*controller_); }

  void take_scene(Controller& controller) const {
    EXPECT_TRUE(controller.configure(testing::walking_config()));
    EXPECT_TRUE(controller.load_scene({&ball_.object(), 1}, {.tool_radius_m = 0.002}));
  }

  void tick() {
    const testing::TickInput input = walk_.next(controller_->mode());
    give(*controller_, input);
    recorder_->add({.record = controller_->record()}, *controller_);
  }

  void run(std::size_t ticks) {
    for (std::size_t i = 0; i < ticks; ++i) {
      tick();
    }
  }

  // Returns how many ticks of another round of the memory a test makes.
  static std::size_t beyond(std::size_t round) {
    return std::max(round / 8, testing::part_of(round));
  }

  // Ticks of the window that give the same hash once more, up to the first that does not.
  std::uint64_t equal_ticks(const FlightWindow& window) const {
    const auto again = std::make_unique<Controller>();
    take_scene(*again);
    EXPECT_TRUE(again->restore(window.state));
    RecordedTick recorded;
    std::uint64_t tick = window.first_tick;
    for (; tick < window.end_tick && recorder_->ticks().read(tick, recorded); ++tick) {
      repeat_tick(*again, recorded.record);
      if (again->record().state_hash != recorded.record.state_hash) {
        break;
      }
    }
    return tick - window.first_tick;
  }

  Solid ball_{testing::bumpy_sphere(0.03, 2, 0.1), rendering::Sides::one, testing::kRough};
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  std::unique_ptr<FlightRecorder> recorder_ = std::make_unique<FlightRecorder>();
  SceneWalk walk_{{&ball_.object(), 1}, 5};
};

TEST_F(FlightRecorderTest, HasNothingBeforeTheFirstTick) {
  EXPECT_FALSE(recorder_->hold());
  tick();
  const auto window = recorder_->hold();
  ASSERT_TRUE(window);
  EXPECT_EQ(window->first_tick, 1U);
  EXPECT_EQ(window->end_tick, 1U);
}

TEST_F(FlightRecorderTest, CanAlwaysReplayFiveEighthsOfItsMemory) {
  run(kFlightTicks);
  for (int times = 0; times < std::max(8, testing::part_of(40)); ++times) {
    run(517);
    const auto window = recorder_->hold();
    ASSERT_TRUE(window);
    EXPECT_EQ(window->end_tick, controller_->record().tick + 1);
    EXPECT_GE(window->end_tick - window->first_tick, 5 * kFlightTicks / 8 - 1);
    recorder_->release();
  }
}

TEST_F(FlightRecorderTest, GivesAWindowThatReplaysToTheSameHashes) {
  run(kFlightTicks + beyond(kFlightTicks) + 1234);
  const auto window = recorder_->hold();
  ASSERT_TRUE(window);
  EXPECT_EQ(equal_ticks(*window), window->end_tick - window->first_tick);
}

TEST_F(FlightRecorderTest, KeepsAStateThatIsHeldAndSaysWhichTicksAreGone) {
  run(kFlightTicks);
  const auto window = recorder_->hold();
  ASSERT_TRUE(window);
  const std::vector<std::byte> state(window->state.begin(), window->state.end());
  const std::uint64_t end = 2 * kFlightTicks + beyond(kFlightTicks);
  run(end - kFlightTicks);
  EXPECT_TRUE(std::ranges::equal(state, window->state));
  RecordedTick record;
  EXPECT_FALSE(recorder_->ticks().read(window->first_tick, record));
  EXPECT_FALSE(recorder_->ticks().read(end, record)) << "a tick that was not yet";
  ASSERT_TRUE(recorder_->ticks().read(end - 1, record));
  EXPECT_EQ(record.record.tick, end - 1);
  const auto next = recorder_->hold();
  ASSERT_TRUE(next);
  EXPECT_EQ(equal_ticks(*next), next->end_tick - next->first_tick);
}

TEST_F(FlightRecorderTest, BeginsAnewWhereTheRunDoes) {
  run(3000);
  take_scene(*controller_);
  run(100);
  const auto window = recorder_->hold();
  ASSERT_TRUE(window);
  EXPECT_EQ(window->first_tick, 1U);
  EXPECT_EQ(equal_ticks(*window), 99U);
  run(10'000);
  recorder_->forget();
  run(50);
  const auto later = recorder_->hold();
  ASSERT_TRUE(later);
  EXPECT_EQ(equal_ticks(*later), 49U);
  RecordedTick record;
  EXPECT_FALSE(recorder_->ticks().read(later->first_tick - 2, record));
}

TEST_F(FlightRecorderTest, IsCopiedOutWhileTheLoopGoesOn) {
  run(kFlightTicks);
  std::atomic<bool> done{false};
  std::jthread loop([&] {
    while (!done.load()) {
      tick();
    }
  });
  for (int times = 0; times < std::max(3, testing::part_of(10)); ++times) {
    const auto window = recorder_->hold();
    ASSERT_TRUE(window);
    // The loop runs at full speed here, and may overtake; what can be read is right.
    RecordedTick recorded;
    const auto again = std::make_unique<Controller>();
    take_scene(*again);
    ASSERT_TRUE(again->restore(window->state));
    std::uint64_t tick = window->first_tick;
    while (tick < window->end_tick && recorder_->ticks().read(tick, recorded)) {
      ASSERT_EQ(recorded.record.tick, tick);
      repeat_tick(*again, recorded.record);
      ASSERT_EQ(again->record().state_hash, recorded.record.state_hash);
      ++tick;
    }
    recorder_->release();
  }
  done.store(true);
}

}  // namespace
}  // namespace tactus::firmware
