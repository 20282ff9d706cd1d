#include "firmware/commands/stop_slot.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/share.h"

namespace tactus::firmware {
namespace {

TEST(StopSlot, ATickCarriesOutAllStopsThatItHasSeen) {
  StopSlot slot;
  EXPECT_FALSE(slot.take());
  const std::uint32_t first = slot.post();
  const std::uint32_t second = slot.post();
  EXPECT_TRUE(slot.take());
  EXPECT_FALSE(slot.take()) << "each stop is for one tick";
  EXPECT_FALSE(slot.taken(first));
  const std::uint32_t late = slot.post();
  EXPECT_TRUE(slot.answer({.tick = 7, .after = Mode::fault}));
  EXPECT_FALSE(slot.answer({.tick = 8, .after = Mode::fault}));
  for (const std::uint32_t stop : {first, second}) {
    ASSERT_TRUE(slot.taken(stop));
    EXPECT_EQ(slot.taken(stop)->tick, 7U);
    EXPECT_EQ(slot.taken(stop)->after, Mode::fault);
  }
  EXPECT_FALSE(slot.taken(late)) << "the tick has not seen it";
  EXPECT_TRUE(slot.take());
  EXPECT_TRUE(slot.answer({.tick = 9, .after = Mode::fault}));
  EXPECT_EQ(slot.taken(late)->tick, 9U);
}

TEST(StopSlot, BetweenThreadsEveryStopIsAnswered) {
  const int kStops = tactus::testing::share_of(20'000);
  StopSlot slot;
  std::jthread poster([&] {
    for (int i = 0; i < kStops; ++i) {
      const std::uint32_t stop = slot.post();
      while (!slot.taken(stop)) {
        std::this_thread::yield();
      }
    }
  });
  int answers = 0;
  for (std::uint64_t tick = 0; answers < kStops; ++tick) {
    if (slot.take()) {
      EXPECT_TRUE(slot.answer({.tick = tick, .after = Mode::fault}));
      ++answers;
    } else {
      std::this_thread::yield();
    }
  }
}

}  // namespace
}  // namespace tactus::firmware
