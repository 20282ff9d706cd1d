// The types of edges and vertices against solids whose types are known.
#include "host_tools/graph/connection_graph.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/unit/host_tools/graph/graphs.h"

namespace tactus::host {
namespace {

using testing::graph_of;
using testing::Shape;

std::size_t number_of(const ConnectionGraph& graph, ConnectionType type) {
  return count(graph).of_connections[static_cast<std::size_t>(type)];
}

std::size_t number_of(const ConnectionGraph& graph, CornerType type) {
  return count(graph).of_corners[static_cast<std::size_t>(type)];
}

void turn_inside_out(Shape& shape) {
  for (rendering::TriangleIndices& t : shape.triangles) {
    std::swap(t[1], t[2]);
  }
}

TEST(ConnectionGraph, OfACubeHasTwelveConvexEdgesSixDiagonalsAndEightConvexVertices) {
  const ConnectionGraph graph = graph_of(testing::box({0.02, 0.02, 0.02}));
  EXPECT_EQ(graph.nodes.size(), 12U);
  EXPECT_EQ(graph.flat_faces, 6U);
  EXPECT_EQ(number_of(graph, ConnectionType::convex), 12U);
  EXPECT_EQ(number_of(graph, ConnectionType::flat), 6U);
  EXPECT_EQ(number_of(graph, CornerType::convex), 8U);
  EXPECT_EQ(count(graph).euler(), 2);
  for (const Connection& connection : graph.connections) {
    if (connection.type == ConnectionType::convex) {
      EXPECT_NEAR(connection.inner_angle, 0.5 * std::numbers::pi, 1e-6);
    }
  }
}

TEST(ConnectionGraph, OfACubeInsideOutIsConcave) {
  Shape cube = testing::box({0.02, 0.02, 0.02});
  turn_inside_out(cube);
  const ConnectionGraph graph = graph_of(cube);
  EXPECT_EQ(number_of(graph, ConnectionType::concave), 12U);
  EXPECT_EQ(number_of(graph, ConnectionType::flat), 6U);
  EXPECT_EQ(number_of(graph, CornerType::concave), 8U);
}

TEST(ConnectionGraph, FindsDiagonalsFlatHoweverTheMeshIsTurnedAndMoved) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Shape cube =
        testing::moved(testing::turned(testing::box({0.02, 0.003, 0.05}),
                                       {in(random), in(random), in(random)}, 3.0 * in(random)),
                       {0.3 * in(random), 0.3 * in(random), 0.3 * in(random)});
    const ConnectionGraph graph = graph_of(cube);
    EXPECT_EQ(number_of(graph, ConnectionType::convex), 12U);
    EXPECT_EQ(number_of(graph, ConnectionType::flat), 6U);
    EXPECT_EQ(graph.flat_faces, 6U);
  }
}

TEST(ConnectionGraph, OfAStepHasOneConcaveEdgeBetweenTwoPartlyConvexVertices) {
  const ConnectionGraph graph = graph_of(testing::step());
  EXPECT_EQ(number_of(graph, ConnectionType::concave), 1U);
  EXPECT_EQ(number_of(graph, ConnectionType::convex), 17U);
  EXPECT_EQ(number_of(graph, CornerType::partly_convex), 2U);
  EXPECT_EQ(number_of(graph, CornerType::convex), 10U);
  EXPECT_EQ(graph.flat_faces, 8U);
  const auto groove =
      std::ranges::find(graph.connections, ConnectionType::concave, &Connection::type);
  EXPECT_NEAR(groove->inner_angle, 1.5 * std::numbers::pi, 1e-6);
  for (const std::uint32_t corner : groove->corners) {
    EXPECT_EQ(graph.corners[corner].type, CornerType::partly_convex);
    EXPECT_EQ(graph.corners[corner].position.head<2>(), Eigen::Vector2d(1.0, 1.0));
  }
}

TEST(ConnectionGraph, OfASheetHasOpenEdgesAndBorderVertices) {
  const ConnectionGraph graph = graph_of(testing::flat_sheet(0.01, 4));
  EXPECT_EQ(number_of(graph, ConnectionType::open), 16U);
  EXPECT_EQ(number_of(graph, ConnectionType::flat), graph.connections.size() - 16U);
  EXPECT_EQ(number_of(graph, CornerType::border), 16U);
  EXPECT_EQ(number_of(graph, CornerType::flat), 9U);
  EXPECT_EQ(graph.flat_faces, 1U);
  EXPECT_EQ(count(graph).euler(), 1);
}

TEST(ConnectionGraph, FollowsEulersFormula) {
  EXPECT_EQ(count(graph_of(testing::icosphere(0.03, 3))).euler(), 2);
  EXPECT_EQ(count(graph_of(testing::torus(0.03, 0.01, 24, 12))).euler(), 0);
  EXPECT_EQ(count(graph_of(testing::star(5, 0.03, 0.01, 0.01))).euler(), 2);
  // The seam of this tube is not joined, so it is a rolled rectangle.
  EXPECT_EQ(count(graph_of(testing::open_tube(12, 0.01, 0.02))).euler(), 1);
  EXPECT_EQ(count(graph_of(testing::disc(12, 0.01, 0.0))).euler(), 1);
  EXPECT_EQ(count(graph_of(testing::joined(testing::box({0.01, 0.01, 0.01}),
                                           testing::icosphere(0.01, 1))))
                .euler(),
            4);
}

TEST(ConnectionGraph, HasTheAnglesOfRegularSolids) {
  for (const Connection& edge : graph_of(testing::icosphere(0.03, 0)).connections) {
    EXPECT_EQ(edge.type, ConnectionType::convex);
    EXPECT_NEAR(edge.inner_angle, std::acos(-std::sqrt(5.0) / 3.0), 1e-5);
  }
  for (const int sides : {3, 5, 12, 48}) {
    const ConnectionGraph graph = graph_of(testing::prism(sides, 0.02, 0.03));
    const double between_sides = std::numbers::pi * (1.0 - 2.0 / sides);
    const auto is_near = [](const Connection& edge, double angle) {
      return edge.type == ConnectionType::convex && std::abs(edge.inner_angle - angle) < 1e-4;
    };
    EXPECT_EQ(std::ranges::count_if(graph.connections,
                                    [&](const Connection& e) { return is_near(e, between_sides); }),
              sides);
    EXPECT_EQ(std::ranges::count_if(graph.connections,
                                    [&](const Connection& e) { return is_near(e, 0.5 * M_PI); }),
              2 * sides);
  }
}

// An independent test of the type: the third vertex of one face is behind the plane of the other.
TEST(ConnectionGraph, AgreesWithTheSideOfTheVertexAcross) {
  const Shape shape = testing::bumpy_sphere(0.03, 4, 0.2);
  const ConnectionGraph graph = graph_of(shape);
  EXPECT_GT(number_of(graph, ConnectionType::concave), 100U);
  for (const Connection& edge : graph.connections) {
    ASSERT_EQ(edge.nodes.size(), 2U);
    const rendering::TriangleIndices& t = shape.triangles[edge.nodes[0].node];
    const auto at = [&](std::uint32_t v) { return rendering::to_vec3(shape.vertices[v]); };
    const rendering::TriangleIndices& other = shape.triangles[edge.nodes[1].node];
    const auto across = std::ranges::find_if(
        other, [&](std::uint32_t v) { return v != edge.corners[0] && v != edge.corners[1]; });
    const Vec3 p = at(*across);
    const double volume = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).dot(p - at(t[0]));
    if (edge.type == ConnectionType::convex) {
      EXPECT_LT(volume, 0.0);
    } else if (edge.type == ConnectionType::concave) {
      EXPECT_GT(volume, 0.0);
    }
  }
}

TEST(ConnectionGraph, NamesFaultyEdgesAndTheirVertices) {
  const std::vector<rendering::Float3> vertices = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<rendering::TriangleIndices> twisted = {{0, 1, 2}, {0, 1, 3}};
  const ConnectionGraph two = connection_graph(vertices, twisted);
  EXPECT_EQ(two.connections[0].type, ConnectionType::inconsistent);
  EXPECT_EQ(two.corners[0].type, CornerType::irregular);
  EXPECT_EQ(two.corners[2].type, CornerType::border);
  const std::vector<rendering::TriangleIndices> fan = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const ConnectionGraph three = connection_graph(vertices, fan);
  EXPECT_EQ(three.connections[0].type, ConnectionType::non_manifold);
  EXPECT_EQ(three.connections[0].nodes.size(), 3U);
  EXPECT_EQ(number_of(three, CornerType::irregular), 2U);
}

TEST(ConnectionGraph, NamesVerticesInWhichSurfacesTouchAlone) {
  // Two tetrahedra with one vertex in common.
  const std::vector<rendering::Float3> vertices = {{0, 0, 0},   {1, 0, 1},   {0, 1, 1}, {-1, -1, 1},
                                                   {-1, 0, -1}, {0, -1, -1}, {1, 1, -1}};
  const std::vector<rendering::TriangleIndices> triangles = {
      {0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  const ConnectionGraph graph = connection_graph(vertices, triangles);
  EXPECT_EQ(graph.corners[0].type, CornerType::irregular);
  EXPECT_EQ(number_of(graph, CornerType::irregular), 1U);
  EXPECT_EQ(number_of(graph, CornerType::convex), 6U);
}

TEST(ConnectionGraph, TakesAKnifesEdgeForConvex) {
  const std::vector<rendering::Float3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<rendering::TriangleIndices> sheet = {{0, 1, 2}, {0, 2, 1}};
  const ConnectionGraph graph = connection_graph(vertices, sheet);
  EXPECT_EQ(number_of(graph, ConnectionType::convex), 3U);
  EXPECT_EQ(graph.connections[0].inner_angle, 0.0);
}

TEST(ConnectionGraph, HasPlanesThroughTheirFeaturesAndPerpendicularToThem) {
  const Shape shape = testing::bumpy_sphere(0.03, 2, 0.2);
  const ConnectionGraph graph = graph_of(shape);
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Connection& edge = graph.connections[graph.nodes[i].connections[k]];
      const auto side = std::ranges::find(edge.nodes, i, &ConnectedNode::node);
      ASSERT_NE(side, edge.nodes.end());
      EXPECT_EQ(side->edge, k);
      EXPECT_NEAR(side->voronoi.normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR(side->voronoi.normal.dot(graph.nodes[i].plane.normal), 0.0, 1e-12);
      const auto at = [&](std::uint32_t corner) {
        return graph.corners[graph.nodes[i].corners[corner % 3]].position;
      };
      EXPECT_NEAR(graph.nodes[i].plane.height(at(k)), 0.0, 1e-12);
      EXPECT_NEAR(side->voronoi.height(at(k)), 0.0, 1e-12);
      EXPECT_NEAR(side->voronoi.height(at(k + 1)), 0.0, 1e-12);
      EXPECT_LT(side->voronoi.height(at(k + 2)), -1e-4);
    }
  }
  for (const Connection& edge : graph.connections) {
    const Vec3& from = graph.corners[edge.corners[0]].position;
    const Vec3& to = graph.corners[edge.corners[1]].position;
    EXPECT_EQ(edge.edge_vector, to - from);
    EXPECT_NEAR(edge.ends[0].height(from), 0.0, 1e-12);
    EXPECT_NEAR(edge.ends[1].height(to), 0.0, 1e-12);
    EXPECT_NEAR(edge.ends[0].height(to), -edge.edge_vector.norm(), 1e-12);
    EXPECT_NEAR(edge.ends[1].height(from), -edge.edge_vector.norm(), 1e-12);
  }
}

}  // namespace
}  // namespace tactus::host
