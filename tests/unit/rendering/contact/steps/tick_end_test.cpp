// The verdicts at the end of a tick, for sub-goals and places that are written down here.
#include "rendering/contact/tick_end.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>

namespace tactus::rendering {
namespace {

using Verdict = TickEnd::Verdict;

// A proxy in free space with a goal at the origin, to which it moves along the x axis.
class TickEndTest : public ::testing::Test {
 protected:
  TickEndTest() { state_.p_W = {0.01, 0.0, 0.0}; }

  // Says that the proxy had settled where it is now, for the goal of this tick.
  void settled_before() {
    state_.is_settled = true;
    state_.settled_for_W = goal_W_;
  }
  void begin() { end_.emplace(state_, goal_W_); }
  Verdict judge(bool settled) {
    return end_->judge({.tool = goal_W_, .settled = settled}, goal_W_, proxy_);
  }
  Verdict moved_to(double x) {
    state_.p_W.x() = x;
    return judge(false);
  }
  Verdict settled_at(double x) {
    state_.p_W.x() = x;
    state_.is_settled = false;
    return judge(true);
  }

  const Vec3 goal_W_ = Vec3::Zero();
  ProxyState state_;
  ContactPlanes planes_;
  ProxyRest rest_;
  const MovingProxy proxy_{.state = state_, .planes = planes_, .rest = rest_};
  std::optional<TickEnd> end_;
};

TEST_F(TickEndTest, AProxyThatComesNearerGoesOnUntilItSettles) {
  begin();
  for (double x = 0.009; x > 0.001; x -= 0.0001) {
    ASSERT_EQ(moved_to(x), Verdict::go_on);
  }
  EXPECT_EQ(settled_at(0.001), Verdict::settled);
  EXPECT_TRUE(state_.is_settled);
  EXPECT_EQ(state_.settled_for_W, goal_W_);
  EXPECT_FALSE(end_->has_gone_back());
}

TEST_F(TickEndTest, AProxyThatComesNoNearerReturnsToTheNearestPlaceAndSettlesThere) {
  begin();
  ASSERT_EQ(moved_to(0.005), Verdict::go_on);
  ASSERT_EQ(moved_to(0.003), Verdict::go_on);
  Verdict verdict = Verdict::go_on;
  int moves = 0;
  bool has_stalled = false;
  while (verdict == Verdict::go_on) {
    has_stalled = has_stalled || end_->is_stalling();
    verdict = moved_to(moves % 2 == 0 ? 0.0030001 : 0.0030002);
    ASSERT_LT(++moves, 100);
  }
  EXPECT_TRUE(has_stalled);
  EXPECT_EQ(verdict, Verdict::gone_back);
  EXPECT_TRUE(end_->has_gone_back());
  EXPECT_EQ(state_.p_W.x(), 0.003);
  EXPECT_FALSE(state_.is_settled);
  EXPECT_EQ(judge(false), Verdict::settled);  // its contact is found, whatever the sub-goal is
  EXPECT_TRUE(state_.is_settled);
  EXPECT_EQ(state_.p_W.x(), 0.003);
}

TEST_F(TickEndTest, UnderAGoalAtRestAProxyStaysUnlessItSettlesNearer) {
  const double start = state_.p_W.x();
  settled_before();
  begin();
  EXPECT_EQ(settled_at(start - 1e-13), Verdict::gone_back);  // rounding
  EXPECT_EQ(state_.p_W.x(), start);
  EXPECT_EQ(judge(true), Verdict::settled);
  settled_before();
  begin();
  EXPECT_EQ(settled_at(start - 1e-9), Verdict::settled);
}

TEST_F(TickEndTest, AfterAGoalThatMovedAProxyMaySettleFarther) {
  settled_before();
  state_.settled_for_W.y() = 2e-9;
  begin();
  EXPECT_EQ(settled_at(0.011), Verdict::settled);
}

TEST_F(TickEndTest, AGoalAtRestStaysTheOneForWhichTheProxyCame) {
  settled_before();
  state_.settled_for_W.y() = 0.5e-9;
  const Vec3 came_for_W = state_.settled_for_W;
  begin();
  EXPECT_EQ(settled_at(state_.p_W.x()), Verdict::settled);
  EXPECT_EQ(state_.settled_for_W, came_for_W);
  EXPECT_EQ(settled_at(0.009), Verdict::settled);
  EXPECT_EQ(state_.settled_for_W, goal_W_);
}

}  // namespace
}  // namespace tactus::rendering
