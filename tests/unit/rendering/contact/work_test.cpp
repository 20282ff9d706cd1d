#include "rendering/contact/work.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Does all that the tick allows, a unit at a time; how much that was.
std::size_t work_out(Work& work) {
  while (!work.is_over()) {
    work.add(1);
  }
  return work.done();
}

void rest(Work& work, std::size_t ticks) {
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    work.begin_tick();
  }
}

constexpr std::size_t kTicksToSaveAll = kMostSavedWork * kTicksToSaveAUnit;

TEST(Work, OfTheFirstTickMayBeTheMost) {
  Work work;
  work.begin_tick();
  EXPECT_EQ(work_out(work), kMaxWork + 1);
}

TEST(Work, OfBusyTicksIsTheUsualOnceNothingIsSaved) {
  Work work;
  const std::size_t beyond = kMaxWork + 1 - kUsualWork;
  for (std::size_t spent = 0; spent + beyond <= kMostSavedWork; spent += beyond) {
    work.begin_tick();
    EXPECT_EQ(work_out(work), kMaxWork + 1);
  }
  work.begin_tick();
  work_out(work);
  for (int tick = 0; tick < 100; ++tick) {
    work.begin_tick();
    EXPECT_LE(work_out(work), kUsualWork + 2) << "tick " << tick;
    EXPECT_GT(work.done(), kUsualWork);
  }
}

TEST(Work, IsSavedByTicksThatDoLittle) {
  Work work;
  for (int tick = 0; tick < 100; ++tick) {
    work.begin_tick();
    work_out(work);
  }
  constexpr std::size_t kSaved = 50;
  rest(work, kSaved * kTicksToSaveAUnit);
  work.begin_tick();
  EXPECT_GE(work_out(work), kUsualWork + kSaved);
  EXPECT_LE(work.done(), kUsualWork + kSaved + 2);
}

TEST(Work, IsNotSavedWithoutEnd) {
  Work rested;
  rest(rested, 3 * kTicksToSaveAll);
  Work fresh;
  for (int tick = 0; tick < 10; ++tick) {
    rested.begin_tick();
    fresh.begin_tick();
    EXPECT_EQ(work_out(rested), work_out(fresh)) << "tick " << tick;
  }
}

// Whatever the ticks ask for: what they do beyond the usual is what was saved at the start and
// since.
TEST(Work, OfManyTicksIsBounded) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    Work work;
    std::uniform_int_distribution<std::size_t> wanted(0, round % 2 == 0 ? 600U : 3000U);
    std::size_t beyond = 0;
    for (std::size_t tick = 1; tick <= 1000; ++tick) {
      work.begin_tick();
      const std::size_t wants = wanted(random);
      while (!work.is_over() && work.done() < wants) {
        work.add(1);
      }
      ASSERT_LE(work.done(), kMaxWork + 1);
      beyond += work.done() > kUsualWork ? work.done() - kUsualWork : 0U;
      ASSERT_LE(beyond, kMostSavedWork + tick / kTicksToSaveAUnit + tick)  // a unit over, each
          << "round " << round << ", tick " << tick;
    }
  }
}

TEST(Work, TellsWhatIsLeft) {
  Work work;
  work.begin_tick();
  EXPECT_EQ(work.left(), kMaxWork);
  work.add(kMaxWork / 2);
  EXPECT_EQ(work.left(), kMaxWork - kMaxWork / 2);
  work.add(kMaxWork);
  EXPECT_EQ(work.left(), 0U);
}

TEST(Work, ThatIsDoneAgainMayBeTheMostAndIsPaidFromWhatIsSaved) {
  Work work;
  for (int tick = 0; tick < 100; ++tick) {
    work.begin_tick();
    work_out(work);
  }
  ASSERT_TRUE(work.can_repeat());
  work.repeat();
  EXPECT_EQ(work_out(work), kMaxWork + 1);
  EXPECT_FALSE(work.can_repeat());
  constexpr std::size_t kSaved = 50;
  rest(work, kSaved * kTicksToSaveAUnit);
  work.repeat();
  work_out(work);
  work.begin_tick();
  EXPECT_LE(work_out(work), kUsualWork + 2);
}

TEST(Work, CanBeDoneAgainUpToHalfTheMost) {
  Work work;
  work.begin_tick();
  work.add(kMaxWork / 2);
  EXPECT_TRUE(work.can_repeat());
  work.add(1);
  EXPECT_FALSE(work.can_repeat());
}

}  // namespace
}  // namespace tactus::rendering
