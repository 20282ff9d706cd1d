#include "rendering/surface/connected_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/support/brute_force.h"
#include "tests/support/connected_solid.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::ConnectedSolid;
using testing::Shape;

std::vector<Shape> closed_shapes() {
  return {testing::box({0.06, 0.02, 0.04}),
          testing::prism(3, 0.04, 0.05),
          testing::star(5, 0.05, 0.012, 0.03),
          testing::cone(7, 0.03, 0.06),
          testing::torus(0.04, 0.012, 24, 12),
          testing::bumpy_sphere(0.04, 3, 0.1),
          testing::grooved_block(20.0, 0.02),
          testing::blade(10.0, 0.05),
          testing::pit(0.02, 0.03)};
}

TEST(ConnectedMesh, SignedDistanceIsBruteForceAndTheWindingNumberTogether) {
  constexpr std::uint64_t kSeed = 51;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.06, 0.06);
  for (const Shape& shape : closed_shapes()) {
    const ConnectedSolid solid(shape);
    const auto triangles = testing::corners_of(shape);
    for (int i = 0; i < testing::share_of(2000); ++i) {
      SCOPED_TRACE(shape.name + ", seed 51, case " + std::to_string(i));
      const Vec3 q(place(random), place(random), place(random));
      double nearest = std::numeric_limits<double>::infinity();
      for (const testing::Corners& t : triangles) {
        nearest = std::min(nearest, (testing::nearest_point(t, q) - q).norm());
      }
      const SurfaceSample at = sample(solid.mesh(), q);
      ASSERT_NEAR(std::abs(at.distance_m), nearest, 1e-9);
      ASSERT_NEAR(at.normal_W.norm(), 1.0, 1e-9);
      if (nearest > 1e-9) {
        ASSERT_EQ(at.distance_m < 0.0, testing::winding_number(shape, q) > 0.5);
      }
    }
  }
}

TEST(ConnectedMesh, NamesTheFeatureThatHoldsTheNearestPoint) {
  const ConnectedSolid solid(testing::box({0.02, 0.02, 0.02}));
  const auto nearest = [&](const Vec3& q) { return nearest_on_mesh(solid.mesh().mesh, q); };
  EXPECT_EQ(nearest({0.02, 0.001, 0.003}).feature.kind, Feature::face);
  EXPECT_EQ(nearest({0.02, 0.02, 0.003}).feature.kind, Feature::edge);
  EXPECT_EQ(nearest({0.02, 0.02, 0.02}).feature.kind, Feature::vertex);
  EXPECT_LT((nearest({0.02, 0.02, 0.02}).point_W - Vec3(0.01, 0.01, 0.01)).norm(), 1e-9);
}

TEST(ConnectedMesh, OnTheSurfaceTheNormalStillPointsOutward) {
  const ConnectedSolid solid(testing::box({0.02, 0.02, 0.02}));
  const auto face = static_cast<double>(0.01F);
  EXPECT_LT((sample(solid.mesh(), {face, 0.001, 0.003}).normal_W - Vec3::UnitX()).norm(), 1e-6);
  const Vec3 corner = sample(solid.mesh(), {face, face, face}).normal_W;
  EXPECT_LT((corner - Vec3::Ones().normalized()).norm(), 1e-6);
}

}  // namespace
}  // namespace tactus::rendering
