// Hulls of more points than the limit, and of points that are hard.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "host_tools/bake/body/convex_hull.h"
#include "host_tools/input_error.h"
#include "tests/support/shapes.h"
#include "tests/support/share.h"
#include "tests/unit/host_tools/bake/body/hull_checks.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::kMaxHullVertices;
using testing::contains;
using testing::expect_hull;
using testing::hull_volume;
using testing::Points;
using testing::random_turn;
using testing::random_vector;

Points on_a_sphere(std::mt19937_64& random, std::size_t count, double radius) {
  Points points(count);
  std::ranges::generate(points, [&] { return Vec3(radius * random_vector(random).normalized()); });
  return points;
}

TEST(LimitedHull, KeepsAllPointsOfASphereWhereTheLimitPermits) {
  std::mt19937_64 random(421);
  const Points points = on_a_sphere(random, 500, 0.05);
  const ConvexHull hull = convex_hull(points, 500);
  EXPECT_EQ(hull.vertices.size(), 500U);
  EXPECT_EQ(hull.faces.size(), 2U * 500U - 4U);
  expect_hull(hull, points);
}

// Returns the distance of p from the hull of the vertices from below and above: that of the nearest
// point which Frank and Wolfe's iteration finds, and of a plane between.
std::pair<double, double> distance_between(const Points& vertices, const Vec3& p) {
  Vec3 q = vertices.front();
  double below = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 toward = p - q;
    const Vec3 support =
        *std::ranges::max_element(vertices, {}, [&](const Vec3& v) { return toward.dot(v); });
    below = std::max(below, toward.dot(p - support) / toward.norm());
    const Vec3 step = support - q;
    if (step.squaredNorm() == 0.0) {
      break;
    }
    q += std::clamp(toward.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
  }
  return {below, (p - q).norm()};
}

TEST(LimitedHull, OfManyPointsHasTheMostVerticesAndTellsWhatItLeavesOut) {
  std::mt19937_64 random(431);
  const double radius = 0.05;
  const Points points = on_a_sphere(random, 3000, radius);
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), kMaxHullVertices);
  expect_hull(hull, points);
  // Sixty-four caps that cover a sphere have a half angle of 0.3 or more.
  EXPECT_GT(hull.left_out_m, 0.04 * radius);
  EXPECT_LT(hull.left_out_m, 0.12 * radius);
  // The point that is left out farthest, found by another way.
  double greatest = 0.0;
  const Vec3* farthest = nullptr;
  for (const Vec3& p : points) {
    double height = 0.0;
    for (const ConvexHull::Face& face : hull.faces) {
      height = std::max(height, face.normal.dot(p) - face.offset_m);
    }
    if (height > greatest) {
      greatest = height;
      farthest = &p;
    }
  }
  const auto [below, above] = distance_between(hull.vertices, *farthest);
  EXPECT_GE(hull.left_out_m, below);
  EXPECT_LT(hull.left_out_m, 1.05 * above);
  EXPECT_LE(left_out_m(hull, std::array{*farthest}), above + 1e-12);
  EXPECT_GE(left_out_m(hull, std::array{*farthest}), below - 1e-12);
}

TEST(LimitedHull, LeavesOutLessTheMoreVerticesItMayHave) {
  const testing::Shape shape = testing::bumpy_sphere(0.05, 5, 0.3);
  double before = 1.0;
  for (const std::size_t most : {8U, 16U, 32U, 64U, 128U, 256U}) {
    const ConvexHull hull = convex_hull(shape.vertices, most);
    EXPECT_LE(hull.vertices.size(), most);
    EXPECT_LT(hull.left_out_m, before);
    before = hull.left_out_m;
  }
  EXPECT_LT(before, 0.001);
}

TEST(LimitedHull, DoesNotDependOnTheOrderOfThePoints) {
  std::mt19937_64 random(433);
  Points points = on_a_sphere(random, 1000, 1.0);
  const auto vertices_of = [](const ConvexHull& hull) {
    std::set<std::array<double, 3>> set;
    for (const Vec3& v : hull.vertices) {
      set.insert({v.x(), v.y(), v.z()});
    }
    return set;
  };
  const auto before = vertices_of(convex_hull(points));
  std::ranges::shuffle(points, random);
  EXPECT_EQ(vertices_of(convex_hull(points)), before);
}

// Sets that are hard: hardly flat, hardly round, noisy planes, rings, and points that nearly meet.
Points hard_points(std::mt19937_64& random, int kind) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double small = std::pow(10.0, -3.0 - 4.0 * std::abs(unit(random)));
  Points points(static_cast<std::size_t>(6 + 200 * std::abs(unit(random))));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p(unit(random), unit(random), unit(random));
    const double angle = 10.0 * p.x();
    const double end = i % 2 == 0 ? 1.0 : -1.0;
    const std::array<Vec3, 10> choices{
        Vec3(p.x(), p.y(), small * p.z()),                    // a thin plate
        Vec3(p.x(), small * p.y(), small * p.z()),            // a needle
        Vec3(std::cos(angle), std::sin(angle), end),          // a cylinder
        Vec3(std::cos(angle), std::sin(angle), small * end),  // a coin
        Vec3(p.x(), p.y(), end + small * 1e-3 * p.z()),       // two noisy planes
        Vec3(std::round(p.x()), std::round(p.y()), std::round(p.z())) + small * 1e-3 * p,
        Vec3(std::round(4 * p.x()), std::round(4 * p.y()), std::round(4 * p.z())),
        Vec3(p.x(), p.x() * p.x(), p.x() * p.x() * p.x()),    // a curve on no plane
        Vec3(p.normalized() + small * 1e-3 * Vec3(1, 2, 3)),  // a ball
        i < 4 ? p : Vec3(Vec3(0.1, 0.2, 0.3) + small * p)};
    points[i] = choices[static_cast<std::size_t>(kind) % choices.size()];
  }
  const Mat3 turn = kind % 3 == 0 ? Mat3(Mat3::Identity()) : random_turn(random);
  const Vec3 offset = kind % 5 == 0 ? Vec3(Vec3::Zero()) : random_vector(random);
  for (Vec3& p : points) {
    p = to_vec3(rendering::to_float3(0.1 * (turn * p) + offset));
  }
  return points;
}

TEST(LimitedHull, IsAPolyhedronAboutHardSetsOrSaysThatTheyAreFlat) {
  std::mt19937_64 random(439);
  int flat = 0;
  const int count = testing::share_of(1500);
  for (int n = 0; n < count; ++n) {
    const Points points = hard_points(random, n);
    try {
      const ConvexHull hull = convex_hull(points);
      expect_hull(hull, points);
      EXPECT_LE(hull.vertices.size(), kMaxHullVertices);
      EXPECT_GT(hull_volume(hull), 0.0);
      if (hull.vertices.size() < kMaxHullVertices / 2) {
        EXPECT_LT(hull.left_out_m, 4.0 * hull_tolerance_m(points)) << n;
      }
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "all points are within")) << n;
      ++flat;
    }
    ASSERT_FALSE(HasFailure()) << n;
  }
  EXPECT_LT(flat, count / 4 + 1);
}

}  // namespace
}  // namespace tactus::host
