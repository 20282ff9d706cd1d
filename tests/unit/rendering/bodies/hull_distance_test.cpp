// Distances and overlaps of hulls against a search over directions and points, and against closed
// forms of the primitives.
#include "rendering/bodies/hull_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Dense>

#include "rendering/bodies/manifold.h"
#include "rendering/bodies/primitive_hull.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::share_of;

struct PlacedSolid {
  PrimitiveHull hull;
  PlacedHull placed;
  PlacedSolid(const Primitive& primitive, const RigidPose& X_WO) {
    hull.make(primitive);
    placed.place(hull.hull(), X_WO);
  }
};

Primitive hull_box(double x, double y, double z) {
  return {.kind = PrimitiveKind::box, .dimensions_m = {x, y, z}};
}

class RandomSolids {
 public:
  explicit RandomSolids(std::uint64_t seed) : random_(seed) {}
  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  RigidPose pose(double far_m) {
    return {.rotation = Eigen::AngleAxisd(number(0.0, 6.0), direction()).toRotationMatrix(),
            .translation = far_m * direction()};
  }
  Primitive solid() {
    const int kind = std::uniform_int_distribution(0, 2)(random_);
    if (kind == 0) {
      return {.kind = PrimitiveKind::sphere, .dimensions_m = {number(0.005, 0.02)}};
    }
    if (kind == 1) {
      return {.kind = PrimitiveKind::capsule,
              .dimensions_m = {number(0.005, 0.02), number(0.005, 0.03)}};
    }
    return hull_box(number(0.005, 0.03), number(0.005, 0.03), number(0.005, 0.03));
  }

 private:
  std::mt19937_64 random_;
};

// Returns how far A and B are apart along a unit axis from A to B.
double gap_along(const PlacedHull& a, const PlacedHull& b, const Vec3& axis) {
  return (b.vertices_W()[b.support(-axis)] - a.vertices_W()[a.support(axis)]).dot(axis);
}

// The distance is the largest gap over all axes, and for overlaps it is minus the depth. Returns
// the largest gap of many random axes, which is not more.
double searched_distance(const PlacedHull& a, const PlacedHull& b, RandomSolids& random) {
  double most = gap_along(a, b, (b.middle_W() - a.middle_W()).normalized());
  for (int i = 0; i < 5000; ++i) {
    most = std::max(most, gap_along(a, b, random.direction()));
  }
  return most;
}

TEST(HullDistance, IsThatOfASearchOverAllAxes) {
  RandomSolids random(7);
  // Some of so many overlap, however small the share of the work is.
  const int pairs = std::max(60, share_of(600));
  int overlaps = 0;
  for (int i = 0; i < pairs; ++i) {
    const PlacedSolid a(random.solid(), random.pose(0.005));
    const PlacedSolid b(random.solid(), random.pose(random.number(0.0, 0.06)));
    const HullSeparation found = separation_of(a.placed, b.placed);
    const double searched = searched_distance(a.placed, b.placed, random);
    overlaps += searched < 0.0 ? 1 : 0;
    EXPECT_NEAR(gap_along(a.placed, b.placed, found.normal_W), found.distance_m, 1e-9) << i;
    EXPECT_GE(found.distance_m, searched - 1e-9) << i << ": no axis separates more";
    EXPECT_NEAR(found.normal_W.norm(), 1.0, 1e-12);
    EXPECT_NEAR((found.on_b_W - found.on_a_W).dot(found.normal_W), found.distance_m, 1e-9);
  }
  EXPECT_GT(overlaps, pairs / 12);
}

TEST(HullDistance, OfSpheresAndCapsulesIsTheClosedForm) {
  RandomSolids random(11);
  for (int i = 0; i < share_of(2000); ++i) {
    const Primitive ball{.kind = PrimitiveKind::sphere, .dimensions_m = {0.01}};
    const Primitive solid = random.solid();
    const RigidPose at = random.pose(0.01);
    const Vec3 center = 0.08 * random.direction();
    const PlacedSolid a(ball, {.translation = center});
    const PlacedSolid b(solid, at);
    Primitive moved = solid;
    moved.X_WO = at;
    const double expected = sample(moved, center).distance_m;
    if (expected < 1e-6) {
      continue;
    }
    const HullSeparation found = separation_of(a.placed, b.placed);
    EXPECT_NEAR(found.distance_m - b.placed.hull().radius_m, expected, 1e-10) << i;
    EXPECT_LT((found.normal_W + sample(moved, center).normal_W).norm(), 1e-6) << i;
  }
}

TEST(Manifold, OfABoxOnABoxHasTheFourCornersOfTheirOverlap) {
  const PlacedSolid below(hull_box(0.03, 0.01, 0.03), {});
  const PlacedSolid above(hull_box(0.02, 0.01, 0.02), {.translation = Vec3(0.02, 0.0199, 0.0)});
  const Manifold manifold = manifold_of(below.placed, above.placed, 1e-3);
  ASSERT_EQ(manifold.count, 4U);
  EXPECT_LT((manifold.normal_W - Vec3::UnitY()).norm(), 1e-12);
  double least_x = 1.0;
  double most_x = -1.0;
  for (const ManifoldPoint& point : manifold.points) {
    EXPECT_NEAR(point.separation_m, -1e-4, 1e-12);
    EXPECT_NEAR(std::abs(point.point_W.z()), 0.02, 1e-12);
    least_x = std::min(least_x, point.point_W.x());
    most_x = std::max(most_x, point.point_W.x());
  }
  EXPECT_NEAR(least_x, 0.0, 1e-12);
  EXPECT_NEAR(most_x, 0.03, 1e-12);
}

TEST(Manifold, OfALyingCapsuleHasBothEnds) {
  const PlacedSolid floor(hull_box(0.1, 0.01, 0.1), {});
  const Primitive capsule{.kind = PrimitiveKind::capsule, .dimensions_m = {0.005, 0.02}};
  const PlacedSolid lying(
      capsule,
      {.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix(),
       .translation = Vec3(0.0, 0.0151, 0.0)});
  const Manifold manifold = manifold_of(floor.placed, lying.placed, 1e-3);
  ASSERT_EQ(manifold.count, 2U);
  EXPECT_NEAR(manifold.points[0].separation_m, 1e-4, 1e-9);
  EXPECT_NEAR(std::abs(manifold.points[0].point_W.x() - manifold.points[1].point_W.x()), 0.04,
              1e-9);
  const Manifold on_plane = manifold_of(Vec3(0.0, 0.01, 0.0), Vec3::UnitY(), lying.placed, 1e-3);
  ASSERT_EQ(on_plane.count, 2U);
  EXPECT_NEAR(on_plane.points[0].separation_m, 1e-4, 1e-9);
}

TEST(Manifold, OfCrossedEdgesIsOnePoint) {
  const auto turned = [](const Vec3& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  constexpr double kEighthTurn = std::numbers::pi / 4;
  const double half_diagonal = 0.01 * std::numbers::sqrt2;
  const PlacedSolid below(hull_box(0.05, 0.01, 0.01),
                          {.rotation = turned(Vec3::UnitX(), kEighthTurn)});
  const PlacedSolid above(hull_box(0.01, 0.01, 0.05),
                          {.rotation = turned(Vec3::UnitZ(), kEighthTurn),
                           .translation = Vec3(0.0, 2.0 * half_diagonal - 1e-5, 0.0)});
  const Manifold manifold = manifold_of(below.placed, above.placed, 1e-3);
  ASSERT_EQ(manifold.count, 1U);
  EXPECT_LT((manifold.normal_W - Vec3::UnitY()).norm(), 1e-9);
  EXPECT_NEAR(manifold.points[0].separation_m, -1e-5, 1e-9);
  EXPECT_LT((manifold.points[0].point_W - Vec3(0.0, half_diagonal, 0.0)).norm(), 1e-4);
}

TEST(Manifold, IsEmptyBeyondItsMargin) {
  const PlacedSolid a(hull_box(0.01, 0.01, 0.01), {});
  const PlacedSolid b(hull_box(0.01, 0.01, 0.01), {.translation = Vec3(0.0, 0.0212, 0.0)});
  EXPECT_EQ(manifold_of(a.placed, b.placed, 1e-3).count, 0U);
  EXPECT_EQ(manifold_of(a.placed, b.placed, 2e-3).count, 4U);
}

}  // namespace
}  // namespace tactus::rendering
