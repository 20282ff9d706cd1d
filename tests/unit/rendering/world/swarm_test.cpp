// The tool is among as many moving objects as a world takes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "rendering/geometry/hierarchy_query.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::kRough;
using testing::Solid;

// Balls that sway and turn about the tool, as many as may move, and never touch one another: the
// oracle asks every triangle of all of them, in the ball's frame.
TEST(Swarm, NoBallComesNearerToTheProxyThanItsRadius) {
  constexpr std::uint64_t kSeed = 37;
  constexpr double kRadius_m = 0.002;
  constexpr double kApart_m = 0.016;
  constexpr double kBall_m = 0.004;
  const Solid ball(testing::icosphere(kBall_m, 1), Sides::one, kRough);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vec3> sways;
  std::vector<Object> objects(kMaxMovers, ball.object());
  for (Object& object : objects) {
    object.moves = true;
    const Vec3 sway{unit(random), unit(random), unit(random)};
    sways.push_back(sway);
  }
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = kRadius_m}));
  std::size_t contacts = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    std::vector<RigidPose> poses;
    for (std::uint32_t i = 0; i < kMaxMovers; ++i) {
      const std::uint32_t row = i / 4 % 4;
      const std::uint32_t layer = i / 16;
      const Vec3 place(i % 4 - 1.5, row - 1.5, layer - 1.5);
      const double phase = 0.05 * tick + i;
      poses.push_back(
          {.rotation = Eigen::AngleAxisd(0.02 * tick, sways[i].normalized()).toRotationMatrix(),
           .translation = kApart_m * place + 0.0018 * std::sin(phase) * sways[i]});
      ASSERT_TRUE(world->set_pose(i, poses[i], {}));
    }
    const double t = 0.01 * tick;
    const Touch touch =
        world->touch({.p_W = 0.02 * Vec3(std::sin(2.3 * t), std::sin(1.7 * t), std::cos(t))});
    ASSERT_EQ(touch.flags & kTouchPinched, 0U) << "tick " << tick;
    contacts += touch.contact != ContactKind::none ? 1U : 0U;
    for (std::size_t i = 0; i < kMaxMovers && (touch.flags & kTouchOverlap) == 0; ++i) {
      const Vec3 proxy_O = poses[i].point_in(touch.proxy_W);
      // Every triangle is within the sphere about its ball's corners.
      if (proxy_O.norm() > kBall_m + kRadius_m + kMicron) {
        continue;
      }
      for (std::uint32_t k = 0; k < ball.object().mesh.triangles.size(); ++k) {
        ASSERT_GE(triangle_of(ball.object().mesh, k).nearest(proxy_O).distance, kRadius_m - kMicron)
            << "seed 37, tick " << tick << ", ball " << i;
      }
    }
  }
  EXPECT_GT(contacts, 100U);
}

}  // namespace
}  // namespace tactus::rendering
