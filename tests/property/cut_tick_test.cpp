// A tick whose budget is spent ends on the proxy's way. Its force is still the spring's from there:
// nothing drops out, nothing pulls, and the proxy is never farther from the tool than a tick before
// and the tool's step allow. The oracles are the spring's law and a world without a limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "rendering/state_archive.h"
#include "rendering/tick_budget.h"
#include "rendering/world/world.h"
#include "tests/property/wanderer.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::kTouchIterationsExhausted;
using rendering::Sides;
using rendering::StateArchive;
using rendering::Touch;
using rendering::World;

// Returns the step, shortened to `most_m` if it is longer.
Vec3 hand_step(const Vec3& step, double most_m) {
  const double length = step.norm();
  return length > most_m ? Vec3{most_m / length * step} : step;
}

// The shapes on which a small budget is spent often.
std::vector<Shape> shapes_to_cut() {
  std::vector<Shape> shapes = wandered_shapes();
  shapes.push_back(icosphere(0.03, 6));
  shapes.push_back(bumpy_sphere(0.03, 6, 0.3));
  return shapes;
}

// A tool that moves by at most 1 mm a tick and stretches the proxy by at most 10 mm, under a budget
// of so few instructions that many ticks are cut.
class CutTick : public ::testing::TestWithParam<double> {
 protected:
  static constexpr double kFewInstructions = 40e3;
  static constexpr std::size_t kRoom = 1 << 22;
  static constexpr double kMostStep_m = 1e-3;
  static constexpr double kMostStretch_m = 0.01;
};

TEST_P(CutTick, PushesAsTheSpringDoesAndComesNoFartherFromTheTool) {
  constexpr double kRounding_N = 1e-6;
  // A move that is lengthened on a curved path may end farther from the tool (curved_path.h).
  const double lengthened_m = 1e-6 + 0.025 * GetParam();
  std::size_t cut = 0;
  std::uint64_t seed = 700;
  const std::vector<Shape> shapes = shapes_to_cut();
  const std::size_t ticks = share_of(std::size_t{400'000}) / shapes.size() + 1;
  for (const Shape& shape : shapes) {
    const Solid solid(shape, shape.closed ? Sides::one : Sides::two, kSlippery);
    const auto world = std::make_unique<World>();
    ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = GetParam()}));
    ASSERT_TRUE(world->set_tick_budget(kFewInstructions));
    const auto unbounded = std::make_unique<World>();
    ASSERT_TRUE(unbounded->set_scene({&solid.object(), 1}, {.tool_radius_m = GetParam()}));
    ASSERT_TRUE(unbounded->set_tick_budget(std::numeric_limits<double>::infinity()));
    std::vector<std::byte> room(kRoom);
    Wanderer wanderer(shape, ++seed);
    Vec3 tool = wanderer.next();
    Touch last = world->touch({.p_W = tool});
    Vec3 last_tool = tool;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      tool += hand_step(wanderer.next() - tool, kMostStep_m);
      tool = last.proxy_W + hand_step(tool - last.proxy_W, kMostStretch_m);
      StateArchive saved = StateArchive::writer(room);
      world->transfer(saved);
      StateArchive restored = StateArchive::reader(std::span(room).first(saved.size()));
      unbounded->transfer(restored);
      const Touch touch = world->touch({.p_W = tool});
      const Touch judge = unbounded->touch({.p_W = tool});
      const Vec3 stretch = touch.proxy_W - tool;
      const double before_m = (last.proxy_W - last_tool).norm();
      ASSERT_LE(stretch.norm(), before_m + (tool - last_tool).norm() + lengthened_m)
          << shape.name << ", tick " << tick;
      const bool is_cut = (touch.flags & kTouchIterationsExhausted) != 0;
      const bool was_pushed = last.contact != rendering::ContactKind::none;
      // The proxy is in free space and nothing pushes: the tool is there too, or has gone round to
      // the other side of what pushed before.
      const bool is_free = touch.force_W == Vec3::Zero() &&
                           (judge.force_W == Vec3::Zero() || last.normal_W.dot(stretch) <= 0.0);
      if (is_cut && was_pushed && !is_free) {
        ++cut;
        ASSERT_LE((touch.force_W - kSlippery.stiffness_N_per_m * stretch).norm(), kRounding_N)
            << shape.name << ", tick " << tick << ", stretch " << stretch.transpose() << ", force "
            << touch.force_W.transpose();
      }
      last = touch;
      last_tool = tool;
    }
  }
  EXPECT_GT(cut, ticks / 100);
  std::printf("radius %.3f m: %zu ticks cut in contact\n", GetParam(), cut);
}

INSTANTIATE_TEST_SUITE_P(Radii, CutTick, ::testing::Values(0.0, 0.002));

}  // namespace
}  // namespace tactus::testing
