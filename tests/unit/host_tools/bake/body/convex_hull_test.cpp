// Hulls against known polytopes and brute force over all planes.
#include "host_tools/bake/body/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "tests/support/share.h"
#include "tests/unit/host_tools/bake/body/hull_checks.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::edge_count;
using testing::expect_hull;
using testing::hull_volume;
using testing::input_error;
using testing::Points;
using testing::random_turn;
using testing::random_vector;

void expect_counts(const ConvexHull& hull, std::size_t vertices, std::size_t faces,
                   std::size_t edges) {
  EXPECT_EQ(hull.vertices.size(), vertices);
  EXPECT_EQ(hull.faces.size(), faces);
  EXPECT_EQ(edge_count(hull), edges);
}

// All sign changes of the points' coordinates.
Points with_all_signs(const Points& points) {
  Points all;
  for (const Vec3& p : points) {
    for (int signs = 0; signs < 8; ++signs) {
      const Vec3 sign((signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -1 : 1,
                      (signs & 4) != 0 ? -1 : 1);
      all.emplace_back(p.cwiseProduct(sign));
    }
  }
  return all;
}

// A polytope of which the numbers of vertices, faces and edges are known.
struct KnownPolytope {
  Points points;
  std::size_t vertices;
  std::size_t faces;
  std::size_t edges;
};

std::vector<KnownPolytope> known_polytopes() {
  const double g = std::numbers::phi;
  Points grid;
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    grid.emplace_back(i % 9, i / 9 % 9, i / 81);
  }
  Points prism;
  for (int k = 0; k < 30; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 30;
    prism.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    prism.emplace_back(std::cos(angle), std::sin(angle), -0.5);
  }
  return {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 4, 4, 6},
          {with_all_signs({{1, 1, 1}}), 8, 6, 12},
          {with_all_signs({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 6, 8, 12},
          {with_all_signs({{0, 1, g}, {1, g, 0}, {g, 0, 1}}), 12, 20, 30},
          {with_all_signs({{1, 1, 1}, {0, 1 / g, g}, {1 / g, g, 0}, {g, 0, 1 / g}}), 20, 12, 30},
          {with_all_signs({{1, 1, 0}, {1, 0, 1}, {0, 1, 1}}), 12, 14, 24},
          {prism, 60, 32, 90},
          {grid, 8, 6, 12}};
}

TEST(ConvexHull, OfKnownPolytopesHasTheirCounts) {
  for (const KnownPolytope& known : known_polytopes()) {
    const ConvexHull hull = convex_hull(known.points);
    expect_counts(hull, known.vertices, known.faces, known.edges);
    expect_hull(hull, known.points);
    EXPECT_LT(hull.left_out_m, 1e-15);
  }
}

TEST(ConvexHull, HasTheSameCountsWhereTurnedPlacesAreRoundedToFloats) {
  std::mt19937_64 random(401);
  for (const KnownPolytope& known : known_polytopes()) {
    for (int n = 0; n < 30; ++n) {
      const Mat3 turn = random_turn(random);
      const Vec3 offset = (n % 3) * random_vector(random);
      std::vector<rendering::Float3> stored;
      Points points;
      for (const Vec3& p : known.points) {
        stored.push_back(rendering::to_float3(0.05 * (turn * p) + offset));
        points.push_back(to_vec3(stored.back()));
      }
      const ConvexHull hull = convex_hull(stored);
      expect_counts(hull, known.vertices, known.faces, known.edges);
      expect_hull(hull, points);
      EXPECT_LT(hull.left_out_m, hull_tolerance_m(points));
    }
  }
}

TEST(ConvexHull, OfABoxHasItsNormalsOffsetsAndVolume) {
  const ConvexHull hull = convex_hull(with_all_signs({{0.1, 0.2, 0.3}}));
  for (const ConvexHull::Face& face : hull.faces) {
    Eigen::Index axis = 0;
    EXPECT_EQ(face.normal.cwiseAbs().maxCoeff(&axis), 1.0);
    EXPECT_DOUBLE_EQ(face.offset_m, 0.1 * static_cast<double>(axis + 1));
    EXPECT_EQ(face.vertices.size(), 4U);
  }
  EXPECT_NEAR(hull_volume(hull), 0.048, 1e-16);
}

using LatticePlane = std::tuple<long, long, long, long>;

// The planes of the hull's faces, by trying the plane through every three points, in whole numbers.
std::set<LatticePlane> all_planes(const std::vector<std::array<long, 3>>& points) {
  std::set<LatticePlane> planes;
  for (const auto& a : points) {
    for (const auto& b : points) {
      for (const auto& c : points) {
        const std::array u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const std::array v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        std::array n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
        const long divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
        if (divisor == 0) {
          continue;
        }
        std::ranges::transform(n, n.begin(), [&](long x) { return x / divisor; });
        const auto along = [&](const std::array<long, 3>& p) {
          return n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
        };
        const auto [low, high] = std::ranges::minmax(points, {}, along);
        if (along(high) == along(a) && along(low) < along(a)) {
          planes.emplace(n[0], n[1], n[2], along(a));
        }
      }
    }
  }
  return planes;
}

TEST(ConvexHull, OfSmallSetsIsThatOfEveryPlaneTried) {
  std::mt19937_64 random(409);
  int volumes = 0;
  for (int n = 0; n < testing::share_of(1500); ++n) {
    // Few places, so that points are often in one plane, on one line, and twice the same.
    const long reach = 1 + n % 4;
    std::uniform_int_distribution<long> place(-reach, reach);
    std::vector<std::array<long, 3>> lattice(static_cast<std::size_t>(4 + n % 13));
    Points points;
    for (auto& p : lattice) {
      p = {place(random), place(random), place(random)};
      points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                          static_cast<double>(p[2]));
    }
    const std::set<LatticePlane> planes = all_planes(lattice);
    if (planes.size() < 4) {
      EXPECT_TRUE(contains(input_error([&] { convex_hull(points); }), "all points are within"));
      continue;
    }
    ++volumes;
    const ConvexHull hull = convex_hull(points);
    // A corner is in three planes or more.
    std::set<std::array<double, 3>> corners;
    for (const auto& p : lattice) {
      const auto here = std::ranges::count_if(planes, [&](const LatticePlane& plane) {
        const auto& [x, y, z, d] = plane;
        return x * p[0] + y * p[1] + z * p[2] == d;
      });
      if (here >= 3) {
        corners.insert(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      }
    }
    std::set<std::array<double, 3>> found;
    for (const Vec3& v : hull.vertices) {
      found.insert({v.x(), v.y(), v.z()});
    }
    EXPECT_EQ(found, corners) << n;
    EXPECT_EQ(hull.vertices.size(), corners.size()) << n;
    EXPECT_EQ(hull.faces.size(), planes.size()) << n;
    expect_hull(hull, points);
  }
  EXPECT_GT(volumes, 0);
}

// The volume by brute force: the sum over all triangles that have no point in front of them.
double volume_by_all_triangles(const Points& points) {
  double volume = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 normal = (points[j] - points[i]).cross(points[k] - points[i]);
        const auto height = [&](const Vec3& p) { return normal.dot(p - points[i]); };
        // The three corners themselves may be a rounding error off.
        constexpr double kRounding = 1e-12;
        const bool is_front =
            std::ranges::all_of(points, [&](const Vec3& p) { return height(p) < kRounding; });
        const bool is_back =
            std::ranges::all_of(points, [&](const Vec3& p) { return height(p) > -kRounding; });
        const double six = points[i].dot(points[j].cross(points[k]));
        volume += (is_front ? six : 0.0) / 6.0 - (is_back ? six : 0.0) / 6.0;
      }
    }
  }
  return volume;
}

TEST(ConvexHull, OfRandomPointsHasTheVolumeOfAllOutermostTriangles) {
  std::mt19937_64 random(419);
  for (int n = 0; n < testing::share_of(20); ++n) {
    Points points(40);
    std::ranges::generate(points, [&] { return random_vector(random); });
    const ConvexHull hull = convex_hull(points);
    EXPECT_NEAR(hull_volume(hull), volume_by_all_triangles(points), 1e-9);
    expect_hull(hull, points);
  }
}

TEST(ConvexHull, RefusesPointsWithoutAVolume) {
  const auto message = [](const Points& points) {
    return input_error([&] { convex_hull(points); });
  };
  EXPECT_TRUE(contains(message({}), "there are none"));
  EXPECT_TRUE(contains(message({{1, 2, 3}}), "of (1, 2, 3) m"));
  EXPECT_TRUE(contains(message({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), "of (1, 2, 3) m"));
  EXPECT_TRUE(contains(message({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), "of the line from"));
  EXPECT_TRUE(contains(message({{0, 0, 0}, {1, 0, 1}, {2, 1, 2}, {3, 7, 3}, {5, -3, 5}}),
                       "of the plane through"));
  EXPECT_TRUE(contains(message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-8}}),
                       "needs a volume; give it a thickness"));
  EXPECT_TRUE(contains(
      message({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::quiet_NaN()}}),
      "vertex 3 is not finite"));
  EXPECT_EQ(convex_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-5}}).faces.size(),
            4U);
}

}  // namespace
}  // namespace tactus::host
