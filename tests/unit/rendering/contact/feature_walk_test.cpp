#include "rendering/contact/feature_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rendering/limits.h"
#include "tests/support/brute_force.h"
#include "tests/support/connected_solid.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::ConnectedSolid;
using testing::Shape;

constexpr Material kFrictionless{.stiffness_N_per_m = 1000.0};
constexpr double kSkin_m = 1e-6;  // thicker than the contact margin within which contact begins

Vec3 random_point(std::mt19937_64& random, double size) {
  std::uniform_real_distribution<double> place(-size, size);
  return {place(random), place(random), place(random)};
}

double in_front(const testing::Corners& t, const Vec3& q) {
  return (t.b - t.a).cross(t.c - t.a).normalized().dot(q - t.a);
}

// One point on one mesh, one-sided unless told otherwise.
class Finger {
 public:
  explicit Finger(const Shape& shape, Sides sides = Sides::one) : solid_(shape), sides_(sides) {}

  void place(const Vec3& p) { walker_.place(p); }
  FeatureRest touch(const Vec3& h, const Material& material = kFrictionless) {
    return walker_.advance(solid_.mesh(), sides_, material, h);
  }
  [[nodiscard]] const ConnectedSolid& solid() const { return solid_; }

 private:
  ConnectedSolid solid_;
  Sides sides_;
  FeatureWalker walker_;
};

TEST(FeatureWalk, OnConvexMeshesEndsAtTheNearestPointFromAnyFaceThatSeesIt) {
  constexpr std::uint64_t kSeed = 131;
  std::mt19937_64 random(kSeed);
  for (const Shape& shape :
       {testing::icosphere(0.04, 3), testing::box({0.06, 0.02, 0.04}),
        testing::prism(3, 0.04, 0.05), testing::cone(24, 0.03, 0.06),
        testing::sliver_box({0.05, 0.03, 0.04}, 0.0005), testing::blade(10.0, 0.05)}) {
    const ConnectedSolid solid(shape);
    const auto triangles = testing::corners_of(solid.shape());
    std::uniform_int_distribution<std::uint32_t> any(
        0, static_cast<std::uint32_t>(triangles.size() - 1));
    for (int i = 0; i < testing::share_of(1000); ++i) {
      const Vec3 q = random_point(random, 0.08);
      if (testing::winding_number(shape, q) > 0.5) {
        continue;
      }
      double nearest = std::numeric_limits<double>::infinity();
      for (const testing::Corners& t : triangles) {
        nearest = std::min(nearest, (testing::nearest_point(t, q) - q).norm());
      }
      std::uint32_t start = any(random);
      while (in_front(triangles[start], q) <= 0.0) {
        start = any(random);
      }
      const FeatureWalk walk = walk_features(solid.mesh(), start, q, 10'000);
      ASSERT_TRUE(walk.complete);
      ASSERT_NEAR(std::sqrt(walk.at.squared_m2), nearest, 1e-9)
          << shape.name << ", seed 131, case " << i;
    }
  }
}

TEST(FeatureWalk, StopsAtItsLimitAndGoesOnFromThere) {
  const ConnectedSolid solid(testing::icosphere(0.04, 4));
  const Vec3 q(0.0, 0.0, 0.08);
  MeshNearest at = walk_features(solid.mesh(), 0, {0.0, 0.0, -0.08}, 10'000).at;
  int ticks = 0;
  for (bool complete = false; !complete; ++ticks) {
    const FeatureWalk walk = walk_features(solid.mesh(), at.feature.triangle, q, 8);
    ASSERT_LE(walk.visited, 8U);
    at = walk.at;
    complete = walk.complete;
    ASSERT_LT(ticks, 1000);
  }
  EXPECT_GT(ticks, 5);
  EXPECT_NEAR(at.point_W.z(), 0.04, 1e-4);
}

TEST(FeatureWalk, RestsOnFaceEdgeAndVertexLikeTheGodObject) {
  Finger pit(testing::pit(0.02, 0.03));
  pit.place({0.001, 0.05, 0.002});
  // Straight down into the pit's tip, then up beside it: vertex, edge or face as brute force says.
  const auto rest_at = [&](const Vec3& h) {
    FeatureRest rest;
    for (int i = 0; i < 3; ++i) {
      rest = pit.touch(h);
    }
    return rest;
  };
  double lowest = 0.0;
  for (const Float3& v : pit.solid().shape().vertices) {
    lowest = std::abs(v.x) < 1e-6F && std::abs(v.z) < 1e-6F
                 ? std::min(lowest, static_cast<double>(v.y))
                 : lowest;
  }
  const FeatureRest tip = rest_at({0.0002, lowest - 0.005, 0.0001});
  EXPECT_EQ(tip.contact, ContactKind::vertex);
  EXPECT_NEAR(tip.proxy_W.y(), lowest, 1e-9);
  EXPECT_NEAR(tip.depth_m, (tip.proxy_W - Vec3(0.0002, lowest - 0.005, 0.0001)).norm(), 1e-12);

  Finger groove(testing::grooved_block(60.0, 0.02));
  groove.place({0.0, 0.05, 0.0});
  const FeatureRest bottom = groove.touch({0.0003, -0.03, 0.004});
  EXPECT_EQ(bottom.contact, ContactKind::edge);
  EXPECT_NEAR(bottom.proxy_W.z(), 0.004, 1e-6);

  Finger box(testing::box({0.04, 0.04, 0.04}));
  box.place({0.001, 0.05, 0.002});
  const FeatureRest top = box.touch({0.003, 0.015, 0.004});
  EXPECT_EQ(top.contact, ContactKind::face);
  EXPECT_LT((top.proxy_W - Vec3(0.003, 0.02, 0.004)).norm(), 1e-8);
  EXPECT_LT((top.normal_W - Vec3::UnitY()).norm(), 1e-9);
  EXPECT_NEAR(top.depth_m, 0.005, 1e-8);
}

TEST(FeatureWalk, DoesNotPopThroughAThinPlateAndSlipsOffItsSide) {
  Finger plate(testing::box({0.04, 0.001, 0.04}));
  plate.place({0.001, 0.01, 0.002});
  for (double y = 0.01; y > -0.01; y -= 1e-4) {
    const FeatureRest rest = plate.touch({0.001, y, 0.002});
    ASSERT_GE(rest.proxy_W.y(), 0.0005 - 1e-8) << y;
  }
  EXPECT_NEAR(plate.touch({0.001, -0.01, 0.002}).depth_m, 0.0105, 1e-8);
  // Beside the plate it goes down round the edge, and is free.
  const FeatureRest beside = plate.touch({0.021, -0.01, 0.002});
  EXPECT_EQ(beside.contact, ContactKind::none);
  EXPECT_EQ(beside.proxy_W, Vec3(0.021, -0.01, 0.002));
}

TEST(FeatureWalk, ASheetWithTwoSidesHoldsOnBothAndLetsGoAtItsBorder) {
  for (const double side : {1.0, -1.0}) {
    Finger sheet(testing::height_field(0.04, 8, 0.0), Sides::two);
    const Vec3 up = side * Vec3::UnitY();
    sheet.place(Vec3(0.001, 0.0, 0.002) + 0.01 * up);
    const FeatureRest on = sheet.touch(Vec3(0.001, 0.0, 0.002) - 0.004 * up);
    EXPECT_EQ(on.contact, ContactKind::face);
    EXPECT_NEAR(on.depth_m, 0.004, 1e-8);
    EXPECT_LT((on.normal_W - up).norm(), 1e-9);
    const FeatureRest off = sheet.touch(Vec3(0.03, 0.0, 0.002) - 0.004 * up);
    EXPECT_EQ(off.contact, ContactKind::none);
  }
}

// Wild motions over solids: free only where the tool is outside, and at rest only where no triangle
// under the point comes nearer to the tool.
TEST(FeatureWalk, IsNeverFreeInsideAndRestsOnlyWhereNothingNextToItIsNearer) {
  constexpr std::uint64_t kSeed = 137;
  for (const Shape& shape :
       {testing::box({0.06, 0.02, 0.04}), testing::star(5, 0.05, 0.012, 0.03),
        testing::torus(0.04, 0.012, 24, 12), testing::bumpy_sphere(0.04, 3, 0.1),
        testing::grooved_block(20.0, 0.02), testing::pit(0.02, 0.03),
        testing::sliver_box({0.05, 0.03, 0.04}, 0.0005)}) {
    std::mt19937_64 random(kSeed);
    Finger finger(shape);
    const auto triangles = testing::corners_of(finger.solid().shape());
    Vec3 h(0.1, 0.1, 0.1);
    finger.place(h);
    Vec3 goal = random_point(random, 0.05);
    for (int i = 0; i < testing::share_of(4000); ++i) {
      SCOPED_TRACE(shape.name + ", seed 137, tick " + std::to_string(i));
      goal = (goal - h).norm() < 1e-3 ? random_point(random, 0.06) : goal;
      h += (i % 97 == 0 ? 0.02 : 5e-4) * (goal - h).normalized();
      const FeatureRest rest = finger.touch(h);
      if (rest.contact == ContactKind::none) {
        if (rest.flags == kTouchClean) {
          ASSERT_EQ(rest.proxy_W, h);
          ASSERT_LT(testing::winding_number(shape, h), 0.5);
        }
        continue;
      }
      if (rest.flags != kTouchClean || rest.depth_m < kSkin_m) {
        continue;
      }
      const double length = (rest.proxy_W - h).norm();
      for (const testing::Corners& t : triangles) {
        if ((testing::nearest_point(t, rest.proxy_W) - rest.proxy_W).norm() < 1e-10) {
          ASSERT_GE((testing::nearest_point(t, h) - h).norm(), length - 1e-8);
        }
      }
    }
  }
}

TEST(FeatureWalk, FrictionHoldsWithinTheConeAndDragsBeyond) {
  constexpr Material kFriction{.stiffness_N_per_m = 1000.0, .friction = cone_friction(0.8, 0.5)};
  Finger box(testing::box({0.1, 0.04, 0.1}));
  box.place({0.0, 0.03, 0.0});
  const double depth = 0.005;
  box.touch({0.0, 0.0201, 0.0}, kFriction);
  box.touch({0.0, 0.02 - depth, 0.0}, kFriction);
  const FeatureRest stuck = box.touch({0.0039, 0.02 - depth, 0.0}, kFriction);
  EXPECT_EQ(stuck.friction, FrictionState::stick);
  EXPECT_NEAR(stuck.proxy_W.x(), 0.0, 1e-9);
  const FeatureRest slipping = box.touch({0.0041, 0.02 - depth, 0.0}, kFriction);
  EXPECT_EQ(slipping.friction, FrictionState::slip);
  EXPECT_NEAR(slipping.proxy_W.x(), 0.0041 - 0.5 * depth, 1e-8);
  EXPECT_NEAR(slipping.depth_m, depth, 1e-8);
}

TEST(FeatureWalk, BadToolPositionsLeaveItWhereItIs) {
  Finger box(testing::box({0.04, 0.04, 0.04}));
  box.place({0.001, 0.05, 0.002});
  const Vec3 good(0.003, 0.015, 0.004);
  const Vec3 proxy = box.touch(good).proxy_W;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e6}) {
    const FeatureRest rest = box.touch({0.0, bad, 0.0});
    EXPECT_EQ(rest.flags, kTouchToolInvalid);
    EXPECT_EQ(rest.contact, ContactKind::none);
    EXPECT_EQ(box.touch(good).proxy_W, proxy);
  }
}

// A stroke of the same number of triangles a tick over spheres of 1 k to 300 k triangles.
TEST(FeatureWalk, VisitsAsManyFeaturesOnLargeMeshesAsOnSmallOnes) {
  constexpr double kRadius_m = 0.1;
  std::vector<double> means;
  std::vector<int> most;
  for (int subdivisions = 3; subdivisions <= 7; ++subdivisions) {
    Finger finger(testing::icosphere(kRadius_m, subdivisions));
    const double edge = 1.2 * kRadius_m / std::exp2(subdivisions);
    const Vec3 axis = Vec3(0.3, 0.8, 0.5).normalized();
    const Vec3 start = axis.unitOrthogonal();
    finger.place(1.2 * kRadius_m * start);
    double sum = 0.0;
    int largest = 0;
    const int ticks = std::max(500, testing::part_of(2'000));
    for (int i = 0; i < ticks; ++i) {
      const double angle = 0.02 * edge / kRadius_m * i;
      const Vec3 h = (kRadius_m - 0.05 * edge) *
                     (std::cos(angle) * start + std::sin(angle) * axis.cross(start));
      const FeatureRest rest = finger.touch(h);
      ASSERT_NE(rest.contact, ContactKind::none);
      ASSERT_EQ(rest.flags, kTouchClean);
      sum += i > 0 ? rest.visited : 0;
      largest = i > 0 ? std::max<int>(largest, rest.visited) : 0;
    }
    means.push_back(sum / ticks);
    most.push_back(largest);
  }
  EXPECT_LE(std::ranges::max(means), 1.01 * std::ranges::min(means));
  EXPECT_LE(std::ranges::max(most), 10);  // a face and a vertex's ring
}

}  // namespace
}  // namespace tactus::rendering
