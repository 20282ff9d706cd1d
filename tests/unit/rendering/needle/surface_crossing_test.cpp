// Crossings of a motion with a closed surface, against every triangle and against inequalities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "rendering/geometry/hierarchy_query.h"
#include "rendering/needle/surface_crossing.h"
#include "tests/support/primitive_points.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/needle/needle_bench.h"

namespace tactus::rendering {
namespace {

using ::tactus::testing::Solid;

// Returns how many times the point is surrounded, by the solid angles of all triangles.
double winding(const MeshView& mesh, const Vec3& p) {
  double angle = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = to_vec3(mesh.vertices[mesh.triangles[t][0]]) - p;
    const Vec3 b = to_vec3(mesh.vertices[mesh.triangles[t][1]]) - p;
    const Vec3 c = to_vec3(mesh.vertices[mesh.triangles[t][2]]) - p;
    const double below = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                         b.dot(c) * a.norm() + c.dot(a) * b.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)), below);
  }
  return angle / (4.0 * std::numbers::pi);
}

TEST(SurfaceCrossing, OfAMeshKnowsWhetherAWanderingPointIsInside) {
  const Solid solid(testing::bumpy_sphere(0.03, 3, 0.2), Sides::one, {});
  const MeshView& mesh = solid.object().mesh;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.04, 0.04);
  Vec3 p(0.1, 0.0, 0.0);
  bool is_inside = false;
  std::size_t crossings = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 to(place(random), place(random), place(random));
    // In many short steps, and in one.
    bool by_steps = is_inside;
    for (int k = 0; k < 20; ++k) {
      const SurfaceCrossing step = crossing_of(mesh, p + (to - p) * (k / 20.0),
                                               k == 19 ? to : p + (to - p) * ((k + 1) / 20.0));
      by_steps = step.enters || step.leaves ? step.ends_inside : by_steps;
    }
    const SurfaceCrossing crossing = crossing_of(mesh, p, to);
    crossings += crossing.enters || crossing.leaves ? 1U : 0U;
    is_inside = crossing.enters || crossing.leaves ? crossing.ends_inside : is_inside;
    ASSERT_EQ(is_inside, winding(mesh, to) > 0.5) << i;
    ASSERT_EQ(by_steps, is_inside) << i;
    p = to;
  }
  EXPECT_GT(crossings, 500U);
}

// Through vertices and along edges of a grid of coordinates that floats hold exactly.
TEST(SurfaceCrossing, DoesNotSlipThroughEdgesAndVertices) {
  const Solid solid(testing::box({0.5, 0.5, 0.5}), Sides::one, {});
  const MeshView& mesh = solid.object().mesh;
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) {
      const Vec3 above(i / 32.0, 1.0, k / 32.0);
      const Vec3 middle(i / 32.0, 0.0, k / 32.0);
      const bool is_rim = std::abs(i) == 8 || std::abs(k) == 8;
      const SurfaceCrossing crossing = crossing_of(mesh, above, middle);
      if (!is_rim) {
        ASSERT_TRUE(crossing.enters && crossing.ends_inside) << i << " " << k;
        EXPECT_NEAR(crossing.entry, 0.75, 1e-12);
      }
    }
  }
}

TEST(SurfaceCrossing, OfAPrimitiveIsWhereItsInsideBegins) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (const PrimitiveKind kind : testing::kAllPrimitives) {
    for (int i = 0; i < 300; ++i) {
      const Primitive primitive = testing::random_primitive(kind, random);
      const Vec3 from =
          primitive.X_WO.translation + Vec3(place(random), place(random), place(random));
      const Vec3 to =
          primitive.X_WO.translation + Vec3(place(random), place(random), place(random));
      const SurfaceCrossing crossing = crossing_of(primitive, from, to);
      ASSERT_EQ(crossing.ends_inside, testing::inside(primitive, to));
      // The first of many points of the way that is inside.
      constexpr int kPointsOfWay = 2000;
      for (int k = 0; k <= kPointsOfWay && !testing::inside(primitive, from); ++k) {
        const double share = k / static_cast<double>(kPointsOfWay);
        if (testing::inside(primitive, from + share * (to - from))) {
          ASSERT_TRUE(crossing.enters) << i << " kind " << static_cast<int>(kind);
          ASSERT_NEAR(crossing.entry, share, 1.0 / kPointsOfWay + 1e-6);
          break;
        }
      }
    }
  }
}

TEST(Needle, FeelsAMeshAsThePrimitiveOfTheSameShape) {
  const Solid solid(testing::box({0.25, 0.25, 0.25}), Sides::one, {});
  Object mesh = solid.object();
  mesh.tissue = 0;
  Object primitive = tissue_block(0.125, 0, -0.125);
  primitive.primitive.dimensions_m = {0.125, 0.125, 0.125};
  const Needle needle{.length_m = 0.1, .width_m = 1e-3};
  NeedleBench of_mesh({mesh}, {balanced_tissue()}, needle);
  NeedleBench of_primitive({primitive}, {balanced_tissue()}, needle);
  ASSERT_TRUE(of_mesh.is_good() && of_primitive.is_good());
  double most_N = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double s = i * 1e-3;
    const Vec3 p_W(0.01 + 2e-4 * std::sin(s), 0.126 - 0.03 * (1.0 - std::cos(0.7 * s)), 0.003);
    const Vec3 force_W = of_mesh.to(p_W).force_W;
    ASSERT_LT((force_W - of_primitive.to(p_W).force_W).norm(), 1e-6) << i;
    most_N = std::max(most_N, force_W.y());
  }
  EXPECT_GT(most_N, 1.4);
}

}  // namespace
}  // namespace tactus::rendering
