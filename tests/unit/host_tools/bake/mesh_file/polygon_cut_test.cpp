#include "host_tools/bake/mesh_file/polygon_cut.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace tactus::host {
namespace {

using Polygon = std::vector<Vec3>;

// The cut of a polygon with its corners in order.
struct TriedCut {
  explicit TriedCut(const Polygon& polygon) : vertices(polygon) {
    std::vector<std::uint32_t> corners(polygon.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
    simple = cut.make(vertices, corners);
  }

  // The sum of the triangles' areas, each positive if it winds with `normal`. Also the sum of their
  // sizes, which is larger where triangles overlap or wind the other way.
  [[nodiscard]] std::pair<double, double> areas(const Vec3& normal) const {
    double signed_sum = 0.0;
    double sum = 0.0;
    for (const auto& t : cut.triangles()) {
      const Vec3 a = vertices[t[0]];
      const Vec3 cross = (vertices[t[1]] - a).cross(vertices[t[2]] - a) / 2.0;
      signed_sum += cross.dot(normal);
      sum += cross.norm();
    }
    return {signed_sum, sum};
  }

  Polygon vertices;
  PolygonCut cut;
  bool simple = false;
};

void expect_area(const Polygon& polygon, double area, const Vec3& normal = Vec3::UnitZ()) {
  const TriedCut cut(polygon);
  EXPECT_TRUE(cut.simple);
  EXPECT_EQ(cut.cut.triangles().size(), polygon.size() - 2);
  const auto [signed_sum, sum] = cut.areas(normal);
  EXPECT_NEAR(signed_sum, area, 1e-12 * area);
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(PolygonCut, CoversAQuadrilateralOnce) {
  expect_area({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 2.0);
  // An arrowhead with each of its corners first in turn.
  Polygon arrow{{0, 0, 0}, {4, -2, 0}, {1, 0, 0}, {4, 2, 0}};
  for (int i = 0; i < 4; ++i) {
    expect_area(arrow, 2.0);
    std::ranges::rotate(arrow, arrow.begin() + 1);
  }
}

TEST(PolygonCut, CoversAConcavePolygonOnce) {
  // A comb with three teeth.
  expect_area({{0, 0, 0},
               {5, 0, 0},
               {5, 2, 0},
               {4, 2, 0},
               {4, 1, 0},
               {3, 1, 0},
               {3, 2, 0},
               {2, 2, 0},
               {2, 1, 0},
               {1, 1, 0},
               {1, 2, 0},
               {0, 2, 0}},
              8.0);
}

TEST(PolygonCut, CoversAPolygonWithCornersOnStraightLines) {
  expect_area(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
      4.0);
}

TEST(PolygonCut, CoversStarsInAnyPlaneFarFromTheOrigin) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(1.0, 3.0);
  std::normal_distribution<double> direction;
  for (std::size_t round = 0; round < 200; ++round) {
    const Vec3 n = Vec3(direction(random), direction(random), direction(random)).normalized();
    const Vec3 u = n.unitOrthogonal();
    const Vec3 v = n.cross(u);
    const std::size_t corners = 5 + round % 40;
    Polygon polygon;
    std::vector<double> radii;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      radii.push_back(radius(random));
      polygon.emplace_back(Vec3(1000, 2000, -3000) +
                           radii.back() * (std::cos(angle) * u + std::sin(angle) * v));
    }
    double area = 0.0;
    for (std::size_t i = 0; i < corners; ++i) {
      area += 0.5 * radii[i] * radii[(i + 1) % corners] *
              std::sin(2.0 * std::numbers::pi / static_cast<double>(corners));
    }
    const TriedCut cut(polygon);
    ASSERT_TRUE(cut.simple) << "round " << round << " of seed 7";
    ASSERT_NEAR(cut.areas(n).first, area, 1e-9 * area);
    ASSERT_NEAR(cut.areas(n).second, area, 1e-9 * area);
  }
}

TEST(PolygonCut, LosesNoTriangleOfAPolygonThatCrossesItselfAndSaysSo) {
  // A pentagram.
  Polygon star;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * std::numbers::pi * 2 * i / 5;
    star.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const TriedCut cut(star);
  EXPECT_EQ(cut.cut.triangles().size(), 3U);
}

TEST(PolygonCut, GivesTrianglesForAPolygonWithoutArea) {
  EXPECT_EQ(
      TriedCut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).cut.triangles().size(), 3U);
  EXPECT_EQ(TriedCut(Polygon(6, Vec3(1, 1, 1))).cut.triangles().size(), 4U);
}

}  // namespace
}  // namespace tactus::host
