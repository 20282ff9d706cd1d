// The proxy on the ridges between the flat faces of a tube.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/support/brute_force.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Corners;
using testing::kMicron;
using testing::Solid;

// A cylinder of 360 sides, 0.87 mm wide: a tool within it goes round, and meets a ridge in every
// second tick.
class RidgeTest : public ::testing::TestWithParam<double> {
 protected:
  static constexpr int kSides = 360;
  static constexpr double kRadius_m = 0.05;
  static constexpr double kDepth_m = 0.001;
  static constexpr double kStep_m = 0.0004;

  [[nodiscard]] Vec3 tool(int tick) const {
    const double angle = 1.0 + kStep_m * tick / kRadius_m;
    const double r = kRadius_m - kDepth_m;
    return {r * std::cos(angle), 0.003, r * std::sin(angle)};
  }
  // Loads the solid and moves the tool onto it from outside.
  void put(const Solid& solid) {
    ASSERT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = GetParam()}));
    for (int i = 20; i >= 0; --i) {
      world_->touch({.p_W = (1.0 + 0.005 * i) * tool(0)});
    }
  }

  std::unique_ptr<World> world_ = std::make_unique<World>();
};

TEST_P(RidgeTest, StaysAsNearToTheToolAsTheSurfaceAllows) {
  const Solid solid(testing::open_tube(kSides, kRadius_m, 0.02), Sides::two, testing::kSlippery);
  const std::vector<Corners> triangles = testing::corners_of(solid.shape());
  put(solid);
  for (int tick = 1; tick < std::max(100, testing::part_of(400)); ++tick) {
    const Vec3 h = tool(tick);
    const Touch t = world_->touch({.p_W = h});
    ASSERT_EQ(t.flags, kTouchClean) << "tick " << tick;
    double depth = std::numeric_limits<double>::infinity();
    for (const Corners& corners : triangles) {
      depth = std::min(depth, (testing::nearest_point(corners, h) - h).norm());
    }
    ASSERT_NEAR((t.proxy_W - h).norm(), depth + GetParam(), kMicron) << "tick " << tick;
    ASSERT_GE(testing::clearance(triangles, t.proxy_W, t.proxy_W, 1.0), GetParam());
  }
}

// One along the face past the ridge, one on the next face.
TEST_P(RidgeTest, TakesTwoMovesOverARidge) {
  const Solid solid(testing::open_tube(kSides, kRadius_m, 0.02), Sides::two, testing::kSlippery);
  put(solid);
  int two = 0;
  int more = 0;
  for (int tick = 1; tick < 400; ++tick) {
    ProxyPath path;
    world_->touch({.p_W = tool(tick)}, &path);
    two += path.count == 3 ? 1 : 0;
    more += path.count > 3 ? 1 : 0;
  }
  EXPECT_GT(two, 100);
  EXPECT_LE(more, 80);  // those that end on a ridge, or go on where the candidates end
}

INSTANTIATE_TEST_SUITE_P(RadiusM, RidgeTest, ::testing::Values(0.0, 0.002));

}  // namespace
}  // namespace tactus::rendering
