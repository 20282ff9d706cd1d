#include "host_tools/benchmark/workload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "rendering/world/world.h"
#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::host {
namespace {

using testing::Solid;

constexpr double kRadius_m = 0.002;

double fastest_step(const std::vector<Vec3>& path) {
  double fastest = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    fastest = std::max(fastest, (path[k] - path[k - 1]).norm());
  }
  return fastest;
}

TEST(StrokeWorkload, PressesASphereByOneToThreeMillimetresAndLeavesItEveryTwoSeconds) {
  const Solid sphere(testing::icosphere(0.1, 5), rendering::Sides::one, {});
  const std::vector<Vec3> path = stroke_workload(sphere.object().mesh, kRadius_m, 4000);
  constexpr double kFacets_m = 1e-4;  // what the mesh lacks of the sphere
  for (std::size_t k = 0; k < path.size(); ++k) {
    const double height = path[k].norm() - (0.1 + kRadius_m);
    const std::size_t phase = k % 2000;
    EXPECT_GE(height, -0.003 - kFacets_m) << k;
    if (phase >= 250 && phase <= 1750) {
      EXPECT_LE(height, -0.001 + kFacets_m) << k;
    }
  }
  EXPECT_NEAR(path[2000].norm(), 0.12 + kRadius_m - 0.002, 1e-3);
  EXPECT_LT(fastest_step(path), 4e-4);
}

TEST(StrokeWorkload, MovesNoFasterThanAHandWhereTheMeshEndsAndAnotherBegins) {
  // The ray meets the small sphere 60 mm farther out than the large one.
  const Solid two(testing::joined(testing::icosphere(0.04, 3),
                                  testing::moved(testing::icosphere(0.01, 3), {0.09, 0.0, 0.0})),
                  rendering::Sides::one, {});
  const std::vector<Vec3> path = stroke_workload(two.object().mesh, kRadius_m, 8000);
  constexpr double kTurning_m = 5e-4;  // tangential, and the lift
  EXPECT_LT(fastest_step(path), 1e-3 * kMostRise_m_per_s + kTurning_m);
}

TEST(HandWorkload, IsNoFasterThanAHandAndStretchesTheProxyNoFartherThanItMay) {
  const Solid two(testing::joined(testing::icosphere(0.04, 3),
                                  testing::moved(testing::icosphere(0.01, 3), {0.09, 0.0, 0.0})),
                  rendering::Sides::one, {.stiffness_N_per_m = 1000.0});
  const std::vector<Vec3> jumps = stroke_workload(two.object().mesh, kRadius_m, 8000);
  const std::vector<Vec3> path = hand_workload(two.object(), kRadius_m, jumps);
  ASSERT_EQ(path.size(), jumps.size());
  EXPECT_LE(fastest_step(path), 1e-3 * kHandSpeed_m_per_s + 1e-12);
  double deepest = 0.0;
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene({&two.object(), 1}, {.tool_radius_m = kRadius_m}));
  for (const Vec3& p : path) {
    deepest = std::max(deepest, (world->touch({.p_W = p}).proxy_W - p).norm());
  }
  EXPECT_GT(deepest, 0.001);
  EXPECT_LE(deepest, kHandStretch_m + kHandSpeed_m_per_s * 1e-3);
}

}  // namespace
}  // namespace tactus::host
