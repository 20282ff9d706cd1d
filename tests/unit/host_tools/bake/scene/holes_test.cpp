// Holes of meshes: where they are, and that they are closed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "host_tools/bake/scene/closed_volume.h"
#include "host_tools/bake/scene/hole_caps.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/mesh_topology.h"
#include "host_tools/bake/scene/open_loops.h"
#include "host_tools/input_error.h"
#include "tests/support/shapes.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::to_vec3;
using rendering::TriangleIndices;
using testing::contains;

constexpr double kBall_m = 0.1;

TriangleMesh mesh_of_shape(const testing::Shape& shape) {
  return {.vertices = {shape.vertices.begin(), shape.vertices.end()},
          .triangles = {shape.triangles.begin(), shape.triangles.end()}};
}

// Takes out the triangles whose corners are all within a distance of one of the places.
TriangleMesh pierced(const testing::Shape& shape, const std::vector<Vec3>& places, double radius) {
  TriangleMesh mesh = mesh_of_shape(shape);
  std::erase_if(mesh.triangles, [&](const TriangleIndices& t) {
    return std::ranges::any_of(places, [&](const Vec3& p) {
      return std::ranges::all_of(
          t, [&](std::uint32_t v) { return (to_vec3(mesh.vertices[v]) - p).norm() < radius; });
    });
  });
  return mesh;
}

bool has_corner(const TriangleIndices& t, std::uint32_t vertex) {
  return std::ranges::find(t, vertex) != t.end();
}

TEST(OpenLoops, AClosedMeshHasNone) {
  const TriangleMesh ball = mesh_of_shape(testing::icosphere(kBall_m, 3));
  EXPECT_TRUE(find_open_loops(ball.vertices, ball.triangles).empty());
  EXPECT_EQ(text_of_loops({}), "");
}

TEST(OpenLoops, AreAsManyAsTheHolesAndWhereTheyAre) {
  constexpr double kRadius = 0.02;
  const std::vector<Vec3> places{{0.0, 0.0, kBall_m}, {kBall_m, 0.0, 0.0}, {0.0, -kBall_m, 0.0}};
  const TriangleMesh ball = pierced(testing::icosphere(kBall_m, 4), places, kRadius);
  const auto loops = find_open_loops(ball.vertices, ball.triangles);
  ASSERT_EQ(loops.size(), places.size());
  std::size_t edges = 0;
  for (const OpenLoop& loop : loops) {
    EXPECT_TRUE(loop.is_closed);
    EXPECT_TRUE(std::ranges::any_of(places, [&](const Vec3& p) {
      return (p - loop.middle_W).norm() < 0.2 * kRadius;
    })) << loop.middle_W.transpose();
    EXPECT_LE(loop.size_m, 2.1 * kRadius);
    EXPECT_GE(loop.size_m, 1.4 * kRadius);
    edges += loop.corners.size();
    for (std::size_t i = 0; i < loop.corners.size(); ++i) {
      const MeshCorner& at = loop.corners[i];
      const MeshCorner& next = loop.corners[(i + 1) % loop.corners.size()];
      EXPECT_EQ(ball.triangles[at.triangle][(at.corner + 1) % 3],
                ball.triangles[next.triangle][next.corner]);
    }
  }
  EXPECT_EQ(edges, find_topology(ball.triangles, ball.vertices.size()).open_edges);
  EXPECT_TRUE(contains(text_of_loops(loops), "3 holes: "));
}

// Two triangles that are missing and share one vertex alone.
TEST(OpenLoops, HolesThatMeetInAVertexStayTwo) {
  const testing::Shape shape = testing::icosphere(kBall_m, 2);
  TriangleMesh ball = mesh_of_shape(shape);
  const std::uint32_t pivot = ball.triangles[0][0];
  std::vector<std::size_t> round;
  for (std::size_t i = 0; i < ball.triangles.size(); ++i) {
    if (has_corner(ball.triangles[i], pivot)) {
      round.push_back(i);
    }
  }
  const auto shares_edge = [&](std::size_t a, std::size_t b) {
    return std::ranges::count_if(ball.triangles[a], [&](std::uint32_t v) {
             return has_corner(ball.triangles[b], v);
           }) == 2;
  };
  const auto other = std::ranges::find_if(
      round, [&](std::size_t i) { return i != round[0] && !shares_edge(i, round[0]); });
  ASSERT_NE(other, round.end());
  ball.triangles.erase(ball.triangles.begin() +
                       static_cast<std::ptrdiff_t>(std::max(*other, round[0])));
  ball.triangles.erase(ball.triangles.begin() +
                       static_cast<std::ptrdiff_t>(std::min(*other, round[0])));
  const auto loops = find_open_loops(ball.vertices, ball.triangles);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0].corners.size(), 3U);
  EXPECT_EQ(loops[1].corners.size(), 3U);
  EXPECT_EQ(cap_holes(ball, 0.1).triangles, 2U);
  EXPECT_EQ(find_topology(ball.triangles, ball.vertices.size()).open_edges, 0U);
}

TEST(OpenLoops, EndAtAnEdgeOfThreeTriangles) {
  // Three triangles about one edge: three chains of two open edges.
  const std::vector<rendering::Float3> vertices{{0.0F, 0.0F, 0.0F},
                                                {0.0F, 0.0F, 1.0F},
                                                {1.0F, 0.0F, 0.0F},
                                                {-1.0F, 1.0F, 0.0F},
                                                {-1.0F, -1.0F, 0.0F}};
  const std::vector<TriangleIndices> fan{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto loops = find_open_loops(vertices, fan);
  ASSERT_EQ(loops.size(), 3U);
  for (const OpenLoop& loop : loops) {
    EXPECT_FALSE(loop.is_closed);
    EXPECT_EQ(loop.corners.size(), 2U);
  }
}

TEST(HoleCaps, CloseHolesOfAnyShapeWithTheirNeighboursWinding) {
  constexpr std::uint64_t kSeed1 = 20261127;
  std::mt19937_64 random(kSeed1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const testing::Shape shape = testing::icosphere(kBall_m, 4);
  const double whole = 4.0 / 3.0 * M_PI * std::pow(kBall_m, 3.0);
  int refused = 0;
  for (int i = 0; i < 50; ++i) {
    // Holes that run into each other are long and bent.
    std::vector<Vec3> places;
    const Vec3 first = Vec3{number(random), number(random), number(random)}.normalized();
    for (int k = 0; k < 4; ++k) {
      const Vec3 beside{number(random), number(random), number(random)};
      places.emplace_back(kBall_m * (first + 0.25 * beside).normalized());
    }
    const TriangleMesh open = pierced(shape, places, 0.016);
    BakedMesh baked;
    try {
      baked = bake_mesh(open, {.cap_holes_m = 0.2});
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "cannot be closed by triangles")) << error.what();
      ++refused;
      continue;
    }
    EXPECT_EQ(baked.counters.open_edges, 0U) << i;
    EXPECT_EQ(baked.counters.non_manifold_edges, 0U) << i;
    EXPECT_EQ(baked.counters.inconsistent_edges, 0U) << i;
    EXPECT_GT(baked.caps.holes, 0U);
    EXPECT_EQ(baked.triangles.size(), open.triangles.size() + baked.caps.triangles);
    const auto volume = closed_volume(baked.baked_view());
    ASSERT_TRUE(volume) << i;
    EXPECT_EQ(volume->inside_out, 0U);
    EXPECT_NEAR(volume->volume_m3, whole, 0.03 * whole) << i;
  }
  EXPECT_LE(refused, 2);
}

TEST(HoleCaps, LeaveLargerHolesOpen) {
  const testing::Shape shape = testing::icosphere(kBall_m, 4);
  TriangleMesh ball = pierced(shape, {{0.0, 0.0, kBall_m}}, 0.05);
  const TriangleMesh small = pierced(shape, {{0.0, 0.0, kBall_m}, {0.0, 0.0, -kBall_m}}, 0.02);
  EXPECT_EQ(cap_holes(ball, 0.05).holes, 0U);
  EXPECT_EQ(bake_mesh(small, {.cap_holes_m = 0.05}).caps.holes, 2U);
  EXPECT_EQ(bake_mesh(small, {.cap_holes_m = 0.005}).caps.holes, 0U);
  EXPECT_EQ(bake_mesh(small).caps.holes, 0U);
}

// A strip that is twisted once has one rim, and no side of it is the front.
TEST(HoleCaps, AHoleThatNoTrianglesCloseIsToldWithItsPlace) {
  TriangleMesh strip = mesh_of_shape(testing::moebius(0.05, 0.02, 24));
  const std::string message = testing::input_error([&] { cap_holes(strip, 1.0); });
  EXPECT_TRUE(contains(message, "cannot be closed by triangles")) << message;
  EXPECT_TRUE(contains(message, " mm at (")) << message;
}

TEST(HoleCaps, HaveTheTexturePlacesOfTheirRim) {
  TriangleMesh ball = mesh_of_shape(testing::icosphere(kBall_m, 2));
  for (const TriangleIndices& t : ball.triangles) {
    rendering::CornerPlaces places{};
    for (std::size_t k = 0; k < 3; ++k) {
      places[k] = {ball.vertices[t[k]].x, ball.vertices[t[k]].y};
    }
    ball.corner_places.push_back(places);
  }
  ball.triangles.erase(ball.triangles.begin() + 7);
  ball.corner_places.erase(ball.corner_places.begin() + 7);
  EXPECT_EQ(cap_holes(ball, 0.1).triangles, 1U);
  ASSERT_EQ(ball.corner_places.size(), ball.triangles.size());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(ball.corner_places.back()[k][0], ball.vertices[ball.triangles.back()[k]].x);
    EXPECT_EQ(ball.corner_places.back()[k][1], ball.vertices[ball.triangles.back()[k]].y);
  }
}

}  // namespace
}  // namespace tactus::host
