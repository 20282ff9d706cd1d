#include "rendering/contact/tick_budget.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Does all that the tick allows, a unit at a time; how much that was.
std::size_t spend_all(TickBudget& budget) {
  while (!budget.is_exhausted()) {
    budget.spend(1);
  }
  return budget.spent();
}

void rest(TickBudget& budget, std::size_t ticks) {
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    budget.begin_tick();
  }
}

constexpr std::size_t kTicksToSaveAll = kMaxSavedBudget * kTicksPerSavedUnit;

TEST(TickBudget, OfTheFirstTickMayBeTheMost) {
  TickBudget budget;
  budget.begin_tick();
  EXPECT_EQ(spend_all(budget), kMaxTickBudget + 1);
}

TEST(TickBudget, OfBusyTicksIsTheUsualOnceNothingIsSaved) {
  TickBudget budget;
  const std::size_t beyond = kMaxTickBudget + 1 - kUsualTickBudget;
  for (std::size_t spent = 0; spent + beyond <= kMaxSavedBudget; spent += beyond) {
    budget.begin_tick();
    EXPECT_EQ(spend_all(budget), kMaxTickBudget + 1);
  }
  budget.begin_tick();
  spend_all(budget);
  for (int tick = 0; tick < 100; ++tick) {
    budget.begin_tick();
    EXPECT_LE(spend_all(budget), kUsualTickBudget + 2) << "tick " << tick;
    EXPECT_GT(budget.spent(), kUsualTickBudget);
  }
}

TEST(TickBudget, IsSavedByTicksThatDoLittle) {
  TickBudget budget;
  for (int tick = 0; tick < 100; ++tick) {
    budget.begin_tick();
    spend_all(budget);
  }
  constexpr std::size_t kSaved = 50;
  rest(budget, kSaved * kTicksPerSavedUnit);
  budget.begin_tick();
  EXPECT_GE(spend_all(budget), kUsualTickBudget + kSaved);
  EXPECT_LE(budget.spent(), kUsualTickBudget + kSaved + 2);
}

TEST(TickBudget, IsNotSavedWithoutEnd) {
  TickBudget rested;
  rest(rested, 3 * kTicksToSaveAll);
  TickBudget fresh;
  for (int tick = 0; tick < 10; ++tick) {
    rested.begin_tick();
    fresh.begin_tick();
    EXPECT_EQ(spend_all(rested), spend_all(fresh)) << "tick " << tick;
  }
}

// The ticks ask for any budget. In sum they spend no more beyond the usual one than was saved at
// the start and since.
TEST(TickBudget, OfManyTicksIsBounded) {
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    TickBudget budget;
    std::uniform_int_distribution<std::size_t> wanted(0, round % 2 == 0 ? 600U : 3000U);
    std::size_t beyond = 0;
    for (std::size_t tick = 1; tick <= 1000; ++tick) {
      budget.begin_tick();
      const std::size_t wants = wanted(random);
      while (!budget.is_exhausted() && budget.spent() < wants) {
        budget.spend(1);
      }
      ASSERT_LE(budget.spent(), kMaxTickBudget + 1);
      beyond += budget.spent() > kUsualTickBudget ? budget.spent() - kUsualTickBudget : 0U;
      ASSERT_LE(beyond, kMaxSavedBudget + tick / kTicksPerSavedUnit + tick)  // a unit over, each
          << "round " << round << ", tick " << tick;
    }
  }
}

TEST(TickBudget, TellsWhatIsLeft) {
  TickBudget budget;
  budget.begin_tick();
  EXPECT_EQ(budget.left(), kMaxTickBudget);
  budget.spend(kMaxTickBudget / 2);
  EXPECT_EQ(budget.left(), kMaxTickBudget - kMaxTickBudget / 2);
  budget.spend(kMaxTickBudget);
  EXPECT_EQ(budget.left(), 0U);
}

TEST(TickBudget, ThatIsDoneAgainMayBeTheMostAndIsPaidFromWhatIsSaved) {
  TickBudget budget;
  for (int tick = 0; tick < 100; ++tick) {
    budget.begin_tick();
    spend_all(budget);
  }
  ASSERT_TRUE(budget.can_repeat());
  budget.allow_repeat();
  EXPECT_EQ(spend_all(budget), kMaxTickBudget + 1);
  EXPECT_FALSE(budget.can_repeat());
  constexpr std::size_t kSaved = 50;
  rest(budget, kSaved * kTicksPerSavedUnit);
  budget.allow_repeat();
  spend_all(budget);
  budget.begin_tick();
  EXPECT_LE(spend_all(budget), kUsualTickBudget + 2);
}

TEST(TickBudget, CanBeDoneAgainUpToHalfTheMost) {
  TickBudget budget;
  budget.begin_tick();
  budget.spend(kMaxTickBudget / 2);
  EXPECT_TRUE(budget.can_repeat());
  budget.spend(1);
  EXPECT_FALSE(budget.can_repeat());
}

}  // namespace
}  // namespace tactus::rendering
