// What every convex hull must keep, and sets of points for tests of it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "host_tools/bake/body/convex_hull.h"
#include "host_tools/bake/body/mass_properties.h"

namespace tactus::testing {

using Points = std::vector<Vec3>;

inline std::size_t edge_count(const host::ConvexHull& hull) {
  std::size_t sides = 0;
  for (const host::ConvexHull::Face& face : hull.faces) {
    sides += face.vertices.size();
  }
  return sides / 2;
}

inline double hull_volume(const host::ConvexHull& hull) {
  return host::mesh_mass_properties(hull.vertices, host::to_triangles(hull), 1.0).mass_kg;
}

inline Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> bell;
  return {bell(random), bell(random), bell(random)};
}

inline Mat3 random_turn(std::mt19937_64& random) {
  std::normal_distribution<double> bell;
  return Eigen::Quaterniond(bell(random), bell(random), bell(random), bell(random))
      .normalized()
      .toRotationMatrix();
}

// Every edge is there once in each direction, and the surface is one sphere.
inline void expect_polyhedron(const host::ConvexHull& hull) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const host::ConvexHull::Face& face : hull.faces) {
    ASSERT_GE(face.vertices.size(), 3U);
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const std::size_t next = (k + 1) % face.vertices.size();
      EXPECT_TRUE(edges.emplace(face.vertices[k], face.vertices[next]).second);
    }
  }
  for (const auto& [from, to] : edges) {
    EXPECT_TRUE(edges.contains({to, from}));
  }
  EXPECT_EQ(hull.vertices.size() + hull.faces.size(), edge_count(hull) + 2);
}

// The points are in all half spaces, but for what is left out and the tolerance; the vertices are
// of the points, and those of a face in its plane.
inline void expect_hull(const host::ConvexHull& hull, const Points& points) {
  expect_polyhedron(hull);
  const double tolerance = host::hull_tolerance_m(points);
  double farthest = 0.0;
  for (const host::ConvexHull::Face& face : hull.faces) {
    EXPECT_NEAR(face.normal.norm(), 1.0, 1e-12);
    for (const Vec3& p : points) {
      farthest = std::max(farthest, face.normal.dot(p) - face.offset_m);
    }
    for (const Vec3& v : hull.vertices) {
      EXPECT_LE(face.normal.dot(v), face.offset_m);
    }
    for (const std::uint32_t vertex : face.vertices) {
      EXPECT_GE(face.normal.dot(hull.vertices[vertex]), face.offset_m - 2.0 * tolerance);
    }
  }
  EXPECT_LE(farthest, hull.left_out_m + 1e-15);
  for (const Vec3& v : hull.vertices) {
    EXPECT_NE(std::ranges::find(points, v), points.end());
  }
}

}  // namespace tactus::testing
