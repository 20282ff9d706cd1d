// The steps of a tick against a clock that the test moves, and the order in which a world shows
// them.
#include "firmware/telemetry/step_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::firmware {
namespace {

using rendering::TickStep;

std::uint64_t g_stepped_ns = 0;
std::uint64_t stepped_now_ns() {
  return g_stepped_ns;
}

std::uint32_t of(const StepTimes& times, TickStep step) {
  return times[static_cast<std::size_t>(step)];
}

TEST(StepTimer, AddsTheTimesOfEachStepAndLeavesOutItsOwn) {
  g_stepped_ns = 100;
  StepTimer timer(stepped_now_ns);
  timer.begin();
  g_stepped_ns += 7;
  timer.end(TickStep::tool);
  for (const std::uint64_t ns : {30U, 12U}) {
    g_stepped_ns += ns;
    timer.end(TickStep::collision);
    g_stepped_ns += 1000;
    timer.skip();
    g_stepped_ns += 5;
    timer.end(TickStep::proxy);
  }
  g_stepped_ns += 3;
  timer.end(TickStep::force);
  const StepTimes times =
      timer.times({.read = 1, .check = 2, .kinematics = 4, .touch = 99, .safety = 8, .write = 16});
  EXPECT_EQ(of(times, TickStep::read), 3U);
  EXPECT_EQ(of(times, TickStep::tool), 4U);
  EXPECT_EQ(of(times, TickStep::collision), 42U);
  EXPECT_EQ(of(times, TickStep::proxy), 10U);
  EXPECT_EQ(of(times, TickStep::force), 3U);
  EXPECT_EQ(of(times, TickStep::command), 24U);
  EXPECT_EQ(of(times, TickStep::objects), 0U);
}

TEST(StepTimer, BeginsEachTickAnewAndHasNoTimesWithoutAClock) {
  g_stepped_ns = 0;
  StepTimer timer(stepped_now_ns);
  g_stepped_ns = 50;
  timer.end(TickStep::proxy);
  timer.begin();
  EXPECT_EQ(timer.times({}), StepTimes{});
  StepTimer without(nullptr);
  g_stepped_ns = 90;
  without.end(TickStep::proxy);
  EXPECT_EQ(without.times({}), StepTimes{});
}

// Notes the steps in their order.
class Order final : public rendering::TickWatcher {
 public:
  void see_step(TickStep step) override { steps.push_back(step); }
  void see(const rendering::WatchedSubGoal& /*sub_goal*/) override {}
  void see_end(const rendering::MovingProxy& /*proxy*/, bool /*is_put_back*/) override {}
  void see(const rendering::WatchedObject& /*object*/,
           const rendering::WatchedFormulaStep& /*step*/) override {}
  void see(const rendering::WatchedObject& /*object*/,
           const rendering::MeshFeature& /*feature*/) override {}
  void see(const rendering::WatchedObject& /*object*/,
           const rendering::WatchedSegment& /*segment*/) override {}

  std::vector<TickStep> steps;
};

TEST(TickSteps, AreShownInTheOrderOfTheLoop) {
  const testing::Solid ball(testing::icosphere(0.02, 2), rendering::Sides::one, testing::kRough);
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002}));
  for (const double x : {0.05, 0.019}) {
    Order order;
    world->touch({.p_W = {x, 0.0, 0.0}}, &order);
    const std::vector<TickStep>& steps = order.steps;
    ASSERT_GE(steps.size(), 5U);
    EXPECT_EQ(steps[0], TickStep::tool);
    EXPECT_EQ(steps[1], TickStep::objects);
    // The force moves the bodies, after the touch.
    EXPECT_EQ(steps[steps.size() - 2], TickStep::force);
    EXPECT_EQ(steps.back(), TickStep::objects);
    const auto collision = std::ranges::find(steps, TickStep::collision);
    const auto proxy = std::ranges::find(steps, TickStep::proxy);
    EXPECT_LT(collision, proxy);
    EXPECT_NE(proxy, steps.end());
    EXPECT_EQ(std::ranges::count(steps, TickStep::tool), 1);
    EXPECT_EQ(std::ranges::count(steps, TickStep::objects), 2);
    // The controller measures these two.
    EXPECT_EQ(std::ranges::count(steps, TickStep::read), 0);
    EXPECT_EQ(std::ranges::count(steps, TickStep::command), 0);
  }
}

TEST(TickSteps, OfOneToolHaveNothingOfTheOthers) {
  const testing::Solid ball(testing::icosphere(0.02, 2), rendering::Sides::one, testing::kRough);
  const auto world = std::make_unique<rendering::WorldOf<2>>();
  ASSERT_TRUE(world->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002, .tool_count = 2}));
  Order one;
  Order other;
  const std::array<rendering::TickWatcher*, 2> watchers{&one, &other};
  const rendering::ToolState tool{.p_W = {0.05, 0.0, 0.0}};
  std::array<rendering::Touch, 2> touches;
  world->touch(std::array{tool, tool}, touches, watchers);
  for (const Order* const order : {&one, &other}) {
    const std::vector<TickStep>& steps = order->steps;
    ASSERT_GE(steps.size(), 7U);
    // The objects move for both; then each has a touch of its own, after what the other's took.
    EXPECT_EQ(steps[0], TickStep::tool);
    EXPECT_EQ(steps[1], TickStep::objects);
    EXPECT_EQ(steps[2], TickStep::tool);
    EXPECT_EQ(steps[steps.size() - 3], TickStep::force);
    EXPECT_EQ(steps[steps.size() - 2], TickStep::tool);
    EXPECT_EQ(steps.back(), TickStep::objects);
    EXPECT_EQ(std::ranges::count(steps, TickStep::tool), 3);
  }
}

}  // namespace
}  // namespace tactus::firmware
