#include "rendering/tick_budget.h"

#include <gtest/gtest.h>

namespace tactus::rendering {
namespace {

constexpr std::size_t kLimit = 1000;

TEST(TickBudget, IsExhaustedOnceMoreThanTheLimitIsSpent) {
  TickBudget budget;
  budget.begin_tick(kLimit);
  budget.spend(kLimit);
  EXPECT_FALSE(budget.is_exhausted());
  budget.spend(1);
  EXPECT_TRUE(budget.is_exhausted());
  EXPECT_EQ(budget.spent(), kLimit + 1);
}

TEST(TickBudget, TellsWhatIsLeft) {
  TickBudget budget;
  budget.begin_tick(kLimit);
  EXPECT_EQ(budget.left(), kLimit);
  budget.spend(kLimit / 4);
  EXPECT_EQ(budget.left(), kLimit - kLimit / 4);
  budget.spend(kLimit);
  EXPECT_EQ(budget.left(), 0U);
}

TEST(TickBudget, OfTheNextTickIsWhole) {
  TickBudget budget;
  budget.begin_tick(kLimit);
  budget.spend(2 * kLimit);
  budget.begin_tick(kLimit);
  EXPECT_FALSE(budget.is_exhausted());
  EXPECT_EQ(budget.left(), kLimit);
}

TEST(TickBudget, CanBeSpentAgainUpToHalfTheLimit) {
  TickBudget budget;
  budget.begin_tick(kLimit);
  budget.spend(kLimit / 2);
  EXPECT_TRUE(budget.can_repeat());
  budget.spend(1);
  EXPECT_FALSE(budget.can_repeat());
}

TEST(TickBudget, BuysUnitsForInstructions) {
  EXPECT_EQ(units_of(kInstructionsPerUnit), 1U);
  EXPECT_EQ(units_of(1000.0 * kInstructionsPerUnit), 1000U);
  EXPECT_EQ(units_of(0.5 * kInstructionsPerUnit), 0U);
}

}  // namespace
}  // namespace tactus::rendering
