// A proxy that slides over the seams of a fine mesh ends a tick early where nothing is left to do.
// The oracle is the same tool for another tick: what has come to its goal comes no nearer to it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

constexpr double kSeamBall_m = 0.05;
constexpr int kStrokes = 1'000;
constexpr int kSeamTicks = 50;

// Walks round the ball at 0.1 to 0.3 m/s, at a depth of 0.5 to 2 mm.
void expect_to_arrive(const Solid& solid, double radius_m) {
  const auto world = std::make_unique<World>();
  std::mt19937_64 random(3);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto direction = [&] {
    return Vec3{between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}.normalized();
  };
  const int strokes = std::max(100, testing::part_of(kStrokes));
  int crossings = 0;
  for (int stroke = 0; stroke < strokes; ++stroke) {
    Vec3 out = direction();
    const double deep_m = kSeamBall_m + radius_m - between(0.5e-3, 2e-3);
    const double step_m = between(0.1e-3, 0.3e-3);
    const Vec3 axis = direction();
    ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = radius_m}));
    world->touch({.p_W = 1.2 * kSeamBall_m * out});
    for (int tick = 0; tick < kSeamTicks; ++tick) {
      out = (out + step_m / kSeamBall_m * axis.cross(out)).normalized();
      const Vec3 tool = deep_m * out;
      ProxyPath path;
      const Touch first = world->touch({.p_W = tool}, &path);
      const Touch again = world->touch({.p_W = tool});
      if (first.flags != kTouchClean || path.count < 3) {
        continue;
      }
      ++crossings;
      constexpr double kArrived_m = 60e-9;  // rest may be uneven by nearly that
      ASSERT_LE((first.proxy_W - tool).norm() - (again.proxy_W - tool).norm(), kArrived_m)
          << "stroke " << stroke << ", tick " << tick;
    }
  }
  EXPECT_GT(crossings, 2 * strokes);
}

TEST(Seam, APointThatSlidOverASeamHasArrived) {
  const Solid rough(testing::icosphere(kSeamBall_m, 6), Sides::one, testing::kRough);
  expect_to_arrive(rough, 0.0);
  const Solid slippery(testing::icosphere(kSeamBall_m, 6), Sides::one, testing::kSlippery);
  expect_to_arrive(slippery, 0.0);
}

TEST(Seam, ASphereThatSlidOverASeamHasArrived) {
  const Solid bumpy(testing::bumpy_sphere(kSeamBall_m, 6, 0.05), Sides::one, testing::kSlippery);
  expect_to_arrive(bumpy, 0.002);
}

}  // namespace
}  // namespace tactus::rendering
