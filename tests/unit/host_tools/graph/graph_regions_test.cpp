// The planes against the nearest feature, found by asking every triangle.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <vector>

#include "host_tools/graph/connection_graph.h"
#include "tests/support/brute_force.h"
#include "tests/support/shapes.h"
#include "tests/unit/host_tools/graph/graphs.h"

namespace tactus::host {
namespace {

using testing::graph_of;
using testing::Shape;

Vec3 random_near(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> in(-reach, reach);
  const double x = in(random);
  const double y = in(random);
  return {x, y, in(random)};
}

// Returns by how much p is beyond the planes of the feature that holds the nearest point.
double beyond_nearest(const ConnectionGraph& graph, std::span<const testing::Corners> triangles,
                      const Vec3& p, std::array<int, 3>& found) {
  constexpr double kAt = 1e-9;
  std::uint32_t best = 0;
  Vec3 nearest = testing::nearest_point(triangles[0], p);
  for (std::uint32_t i = 1; i < triangles.size(); ++i) {
    const double so_far = (nearest - p).norm();
    // A ball about a triangle is nearer than the triangle.
    if ((triangles[i].centre - p).norm() - triangles[i].radius_m > so_far) {
      continue;
    }
    const Vec3 here = testing::nearest_point(triangles[i], p);
    if ((here - p).norm() < so_far) {
      nearest = here;
      best = i;
    }
  }
  const GraphNode& node = graph.nodes[best];
  for (const std::uint32_t corner : node.corners) {
    if ((graph.corners[corner].position - nearest).norm() < kAt) {
      ++found[2];
      return beyond_vertex(graph, corner, p);
    }
  }
  for (const std::uint32_t number : node.connections) {
    const Connection& edge = graph.connections[number];
    const Vec3 from = nearest - graph.corners[edge.corners[0]].position;
    if (edge.edge_vector.normalized().cross(from).norm() < kAt) {
      ++found[1];
      return beyond_edge(graph, number, p);
    }
  }
  ++found[0];
  return beyond_face(graph, best, p);
}

TEST(GraphRegions, HasTheNearestFeatureInWhoseRegionThePointIs) {
  std::mt19937_64 random(11);
  for (const Shape& shape :
       {testing::box({0.03, 0.02, 0.04}), testing::star(5, 0.03, 0.01, 0.03),
        testing::slotted_block(0.004, 0.01), testing::bumpy_sphere(0.02, 2, 0.3),
        testing::torus(0.02, 0.008, 12, 8), testing::flat_sheet(0.01, 3), testing::step()}) {
    const ConnectionGraph graph = graph_of(shape);
    const std::vector<testing::Corners> triangles = testing::corners_of(shape);
    const double reach = shape.name == "step" ? 4.0 : 0.04;
    std::array<int, 3> found{};
    for (int i = 0; i < 1500; ++i) {
      const Vec3 p = random_near(random, reach);
      EXPECT_LT(beyond_nearest(graph, triangles, p, found), 1e-9 + 1e-9 * reach) << shape.name;
    }
    EXPECT_GT(*std::ranges::min_element(found), 10) << shape.name;
  }
}

TEST(GraphRegions, PutsAPointOutsideAConvexMeshIntoOneRegion) {
  std::mt19937_64 random(13);
  for (const Shape& shape : {testing::box({0.03, 0.02, 0.04}), testing::prism(5, 0.02, 0.03),
                             testing::icosphere(0.02, 1)}) {
    const ConnectionGraph graph = graph_of(shape);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = 0.1 * random_near(random, 1.0).normalized();
      int regions = 0;
      for (std::uint32_t n = 0; n < graph.nodes.size(); ++n) {
        regions += graph.nodes[n].plane.height(p) > 0.0 && beyond_face(graph, n, p) < 0.0;
      }
      for (std::uint32_t n = 0; n < graph.connections.size(); ++n) {
        regions +=
            graph.connections[n].type == ConnectionType::convex && beyond_edge(graph, n, p) < 0.0;
      }
      for (std::uint32_t n = 0; n < graph.corners.size(); ++n) {
        regions += beyond_vertex(graph, n, p) < 0.0;
      }
      EXPECT_EQ(regions, 1) << shape.name << " " << p.transpose();
    }
  }
}

}  // namespace
}  // namespace tactus::host
