#include "rendering/surface/primitive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "rendering/limits.h"
#include "tests/support/primitive_points.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::kAllPrimitives;
using testing::random_primitive;

constexpr std::uint64_t kPrimitiveSeed = 31;
constexpr double kStep_m = 1e-6;  // of the differences

// Calls visit(primitive, random point) for every kind in turn.
template <class Visit>
void for_random_points(int primitives, int points, const Visit& visit) {
  std::mt19937_64 random(kPrimitiveSeed);
  std::uniform_real_distribution<double> place(-0.12, 0.12);
  for (int i = 0; i < primitives; ++i) {
    for (const PrimitiveKind kind : kAllPrimitives) {
      const Primitive primitive = random_primitive(kind, random);
      SCOPED_TRACE("seed 31, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      for (int k = 0; k < points; ++k) {
        visit(primitive, Vec3(place(random), place(random), place(random)));
        if (::testing::Test::HasFatalFailure()) {
          return;
        }
      }
    }
  }
}

SurfaceSample seen(PrimitiveKind kind, const std::array<double, 3>& dimensions, const Vec3& p) {
  return sample({.kind = kind, .dimensions_m = dimensions}, p);
}

TEST(Primitive, DistancesAreThoseOfTheClosedForms) {
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::plane, {}, {3, -2, 1}).distance_m, -2.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::sphere, {1}, {0, 3, 4}).distance_m, 4.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::box, {1, 2, 3}, {4, 6, 3}).distance_m, 5.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::box, {1, 2, 3}, {0.5, 0, 0}).distance_m, -0.5);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::cylinder, {1, 2}, {0, 6, 4}).distance_m, 5.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::capsule, {1, 2}, {3, 6, 0}).distance_m, 4.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::cone, {3, 4}, {0, 9, 0}).distance_m, 5.0);
  // The inside point of a 3-4-5 cone that lies 1 from its base and from its side.
  EXPECT_NEAR(seen(PrimitiveKind::cone, {3, 4}, {1, 1, 0}).distance_m, -1.0, 1e-12);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::torus, {5, 1}, {0, 0, 0}).distance_m, 4.0);
  EXPECT_DOUBLE_EQ(seen(PrimitiveKind::torus, {5, 1}, {0, 4, 8}).distance_m, 4.0);
}

TEST(Primitive, DistanceIsThatOfTheNearestOfTheSurfacesPoints) {
  const int points = std::max(4, testing::part_of(12));
  for_random_points(testing::share_of(12), points, [](const Primitive& primitive, const Vec3& p) {
    const auto surface = testing::patches(primitive);
    const SurfaceSample at = sample(primitive, p);
    ASSERT_NEAR(std::abs(at.distance_m), testing::searched_distance(surface, p), 1e-8);
    ASSERT_EQ(at.distance_m < 0.0, testing::inside(primitive, p));
    ASSERT_LT(testing::searched_distance(surface, nearest_point(at, p)), 1e-8);
  });
}

TEST(Primitive, NormalIsTheUnitGradientOfTheDistance) {
  for_random_points(100, 20, [](const Primitive& primitive, const Vec3& p) {
    const SurfaceSample at = sample(primitive, p);
    ASSERT_NEAR(at.normal_W.norm(), 1.0, 1e-12);
    Vec3 difference;
    bool smooth = true;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const SurfaceSample ahead = sample(primitive, p + kStep_m * Vec3::Unit(k));
      const SurfaceSample behind = sample(primitive, p - kStep_m * Vec3::Unit(k));
      difference[k] = (ahead.distance_m - behind.distance_m) / (2.0 * kStep_m);
      smooth = smooth && (ahead.normal_W - behind.normal_W).norm() < 1e-2;
    }
    if (smooth) {
      ASSERT_LT((difference - at.normal_W).norm(), 1e-4);
    }
  });
}

TEST(Primitive, DistanceNeverChangesFasterThanThePointMoves) {
  std::mt19937_64 random(kPrimitiveSeed + 1);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  Vec3 before = Vec3::Zero();
  for_random_points(200, 20, [&](const Primitive& primitive, const Vec3& p) {
    const double change = sample(primitive, p).distance_m - sample(primitive, before).distance_m;
    ASSERT_LE(std::abs(change), (p - before).norm() + 1e-12);
    before = p + 0.01 * Vec3(place(random), place(random), place(random));
  });
}

TEST(Primitive, IsDefinedOnEveryAxisCentreEdgeAndCorner) {
  const std::array<double, 3> dimensions{0.03, 0.01, 0.02};
  for (const PrimitiveKind kind : kAllPrimitives) {
    for (const double x : {0.0, 0.01, 0.02, 0.03, 0.04}) {
      for (const double y : {-0.01, -0.0, 0.0, 0.005, 0.01, 0.02}) {
        for (const double z : {0.0, 0.02, 1e-160, 1e-300}) {
          const SurfaceSample at = seen(kind, dimensions, {x, y, z});
          ASSERT_TRUE(std::isfinite(at.distance_m));
          ASSERT_NEAR(at.normal_W.norm(), 1.0, 1e-12);
        }
      }
    }
  }
  EXPECT_EQ(seen(PrimitiveKind::sphere, {1}, Vec3::Zero()).normal_W, Vec3::UnitX());
  EXPECT_EQ(seen(PrimitiveKind::box, {1, 1, 1}, Vec3::Zero()).normal_W, Vec3::UnitX());
  EXPECT_EQ(seen(PrimitiveKind::cylinder, {1, 5}, Vec3::Zero()).normal_W, Vec3::UnitX());
  EXPECT_EQ(seen(PrimitiveKind::capsule, {1, 5}, {0, 2, 0}).normal_W, Vec3::UnitX());
  EXPECT_EQ(seen(PrimitiveKind::torus, {5, 1}, {0, 0, 5}).normal_W, Vec3::UnitZ());
  EXPECT_EQ(seen(PrimitiveKind::box, {1, 2, 3}, {0, -1.5, 0}).normal_W, -Vec3::UnitY());
}

TEST(Primitive, BoundsAreTheSmallestThatHoldTheSurface) {
  std::mt19937_64 random(kPrimitiveSeed);
  for (int i = 0; i < testing::share_of(50); ++i) {
    for (const PrimitiveKind kind : kAllPrimitives) {
      if (kind == PrimitiveKind::plane) {
        continue;
      }
      const Primitive primitive = random_primitive(kind, random);
      const Bounds box = bounds(primitive);
      Vec3 lower = Vec3::Constant(1.0);
      Vec3 upper = Vec3::Constant(-1.0);
      for (const testing::Patch& patch : testing::patches(primitive)) {
        for (int u = 0; u <= 200; ++u) {
          for (int v = 0; v <= 100; ++v) {
            lower = lower.cwiseMin(patch(u / 200.0, v / 100.0));
            upper = upper.cwiseMax(patch(u / 200.0, v / 100.0));
          }
        }
      }
      ASSERT_TRUE((box.lower_W.array() <= lower.array() + 1e-12).all()) << "seed 31, case " << i;
      ASSERT_TRUE((box.upper_W.array() >= upper.array() - 1e-12).all()) << "seed 31, case " << i;
      ASSERT_LT((box.lower_W - lower).norm() + (box.upper_W - upper).norm(), 1e-4);
    }
  }
  EXPECT_EQ(bounds({.kind = PrimitiveKind::plane}).upper_W, Vec3::Constant(kWorldBound_m));
}

// Returns true if the point sees an edge or a corner of a solid about the origin.
bool sees_edge(PrimitiveKind kind, const PrimitiveDimensions& dimensions_m, const Vec3& p) {
  const Primitive solid{.kind = kind, .dimensions_m = dimensions_m};
  return is_nearest_on_edge(solid, sample(solid, p), p);
}

TEST(Primitive, TellsEdgesAndCornersFromWalls) {
  const PrimitiveDimensions kBox{0.1, 0.2, 0.3};
  EXPECT_FALSE(sees_edge(PrimitiveKind::box, kBox, {0.05, 0.21, -0.1}));
  EXPECT_TRUE(sees_edge(PrimitiveKind::box, kBox, {0.11, 0.21, -0.1})) << "an edge";
  EXPECT_TRUE(sees_edge(PrimitiveKind::box, kBox, {0.11, -0.21, -0.31})) << "a corner";
  EXPECT_FALSE(sees_edge(PrimitiveKind::box, kBox, {0.0, 0.19, 0.0})) << "within it";
  const PrimitiveDimensions kRound{0.1, 0.2};
  EXPECT_FALSE(sees_edge(PrimitiveKind::cylinder, kRound, {0.09, 0.1, 0.09}));
  EXPECT_FALSE(sees_edge(PrimitiveKind::cylinder, kRound, {0.05, 0.21, 0.0}));
  EXPECT_TRUE(sees_edge(PrimitiveKind::cylinder, kRound, {0.09, 0.21, 0.09})) << "the rim";
  EXPECT_FALSE(sees_edge(PrimitiveKind::cone, kRound, {0.1, 0.1, 0.0}));
  EXPECT_TRUE(sees_edge(PrimitiveKind::cone, kRound, {0.0, 0.21, 0.0})) << "the tip";
  EXPECT_TRUE(sees_edge(PrimitiveKind::cone, kRound, {0.12, 0.0, 0.0})) << "the rim";
  EXPECT_FALSE(sees_edge(PrimitiveKind::sphere, kRound, {0.09, 0.1, 0.09}));
  EXPECT_FALSE(sees_edge(PrimitiveKind::capsule, kRound, {0.03, 0.31, 0.0}));
  EXPECT_FALSE(sees_edge(PrimitiveKind::capsule, kRound, {0.12, 0.1, 0.0}));
}

TEST(Primitive, RefusesWhatIsNotASolid) {
  const Primitive good{.kind = PrimitiveKind::torus, .dimensions_m = {0.02, 0.01}};
  EXPECT_TRUE(valid(good));
  EXPECT_TRUE(valid({.kind = PrimitiveKind::plane}));
  Primitive bad = good;
  bad.dimensions_m = {0.01, 0.01};
  EXPECT_FALSE(valid(bad)) << "a torus without a hole";
  bad = good;
  bad.dimensions_m[1] = 0.0;
  EXPECT_FALSE(valid(bad));
  bad.dimensions_m[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(valid(bad));
  bad = good;
  bad.X_WO.rotation(0, 0) = -1.0;
  EXPECT_FALSE(valid(bad)) << "a mirror";
  bad = good;
  bad.X_WO.rotation *= 1.001;
  EXPECT_FALSE(valid(bad));
  bad = good;
  bad.X_WO.translation.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(valid(bad));
  bad = good;
  bad.kind = static_cast<PrimitiveKind>(kPrimitiveKinds);
  EXPECT_FALSE(valid(bad));
  EXPECT_FALSE(valid({.kind = PrimitiveKind::box, .dimensions_m = {1.0, 1.0, -1.0}}));
  EXPECT_FALSE(valid({.kind = PrimitiveKind::sphere, .dimensions_m = {2.0 * kWorldBound_m}}));
}

}  // namespace
}  // namespace tactus::rendering
