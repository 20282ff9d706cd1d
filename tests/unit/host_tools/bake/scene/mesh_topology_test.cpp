#include "host_tools/bake/scene/mesh_topology.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "host_tools/bake/scene/mesh_bake.h"
#include "tests/support/shapes.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::kNoNeighbour;
using rendering::TriangleIndices;

std::size_t count_edges(const testing::Shape& shape) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const TriangleIndices& t : shape.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  return edges.size();
}

Topology topology_of(const testing::Shape& shape) {
  return find_topology(shape.triangles, shape.vertices.size());
}

void expect_closed(const testing::Shape& shape, int euler_characteristic) {
  SCOPED_TRACE(shape.name);
  const Topology topology = topology_of(shape);
  EXPECT_EQ(topology.open_edges, 0U);
  EXPECT_EQ(topology.non_manifold_edges, 0U);
  EXPECT_EQ(topology.inconsistent_edges, 0U);
  const auto v = static_cast<int>(shape.vertices.size());
  const auto e = static_cast<int>(count_edges(shape));
  const auto f = static_cast<int>(shape.triangles.size());
  EXPECT_EQ(v - e + f, euler_characteristic);
  EXPECT_EQ(2 * e, 3 * f) << "every edge has two triangles";
}

TEST(Topology, OfClosedSurfacesHasEulersCharacteristic) {
  expect_closed(testing::icosphere(0.1, 0), 2);
  expect_closed(testing::icosphere(0.1, 3), 2);
  expect_closed(testing::torus(0.1, 0.03, 20, 10), 0);
}

TEST(Topology, LinksTrianglesAcrossTheEdgeThatTheyShare) {
  const testing::Shape sphere = testing::icosphere(0.1, 2);
  const Topology topology = topology_of(sphere);
  for (std::size_t i = 0; i < sphere.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleIndices& other = sphere.triangles[topology.neighbours[i][k]];
      const std::uint32_t from = sphere.triangles[i][k];
      const std::uint32_t to = sphere.triangles[i][(k + 1) % 3];
      bool shares = false;
      for (std::size_t j = 0; j < 3; ++j) {
        if (other[j] == to && other[(j + 1) % 3] == from) {
          shares = true;
          EXPECT_EQ(topology.neighbours[topology.neighbours[i][k]][j], i);
        }
      }
      EXPECT_TRUE(shares) << "triangle " << i << " edge " << k;
    }
  }
}

TEST(Topology, CountsOpenEdges) {
  const std::array<TriangleIndices, 2> square{{{0, 1, 2}, {0, 2, 3}}};
  const Topology topology = find_topology(square, 4);
  EXPECT_EQ(topology.open_edges, 4U);
  EXPECT_EQ(topology.neighbours[0], (rendering::TriangleNeighbours{kNoNeighbour, kNoNeighbour, 1}));
  EXPECT_EQ(topology.neighbours[1], (rendering::TriangleNeighbours{0, kNoNeighbour, kNoNeighbour}));
}

TEST(Topology, CountsEdgesOfThreeTrianglesAndLinksNoneOfThem) {
  const std::array<TriangleIndices, 3> fan{{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  const Topology topology = find_topology(fan, 5);
  EXPECT_EQ(topology.non_manifold_edges, 1U);
  EXPECT_EQ(topology.open_edges, 6U);
  for (const rendering::TriangleNeighbours& neighbours : topology.neighbours) {
    EXPECT_EQ(neighbours[0], kNoNeighbour);
  }
}

TEST(Topology, CountsEdgesThatBothTrianglesRunInOneDirection) {
  const std::array<TriangleIndices, 2> flipped{{{0, 1, 2}, {0, 1, 3}}};
  const Topology topology = find_topology(flipped, 4);
  EXPECT_EQ(topology.inconsistent_edges, 1U);
  EXPECT_EQ(topology.neighbours[0][0], 1U);
}

TEST(Topology, OfAMoebiusStripHasOneOpenRimAndNoConsistentWinding) {
  const testing::Shape strip = testing::moebius(0.1, 0.03, 30);
  const BakedMesh mesh = bake_mesh(strip.vertices, strip.triangles, {.weld_m = 1e-6});
  EXPECT_EQ(mesh.counters.open_edges, 60U);
  EXPECT_EQ(mesh.counters.inconsistent_edges, 1U) << "where its ends meet";
}

TEST(Topology, OfADoubledMeshHasNoManifoldEdge) {
  const testing::Shape sphere = testing::icosphere(0.1, 1);
  const Topology topology = topology_of(testing::doubled(sphere));
  EXPECT_EQ(topology.non_manifold_edges, count_edges(sphere));
  EXPECT_EQ(topology.open_edges, 0U);
}

TEST(AngleWeightedNormals, OfABoxPointAlongItsDiagonalsHoweverItsFacesAreCut) {
  const testing::Shape box = testing::box({0.1, 0.2, 0.3});
  const std::vector<Float3> normals = angle_weighted_normals(box.vertices, box.triangles);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 corner = to_vec3(box.vertices[i]);
    const Vec3 diagonal = Vec3(std::copysign(1.0, corner.x()), std::copysign(1.0, corner.y()),
                               std::copysign(1.0, corner.z())) /
                          std::sqrt(3.0);
    EXPECT_NEAR((to_vec3(normals[i]) - diagonal).norm(), 0.0, 1e-6);
  }
}

TEST(AngleWeightedNormals, OfATetrahedronPointAwayFromItsCentre) {
  const std::vector<Float3> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::vector<TriangleIndices> faces{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const std::vector<Float3> normals = angle_weighted_normals(corners, faces);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((to_vec3(normals[i]) - to_vec3(corners[i]).normalized()).norm(), 0.0, 1e-6);
  }
}

TEST(AngleWeightedNormals, OfASpherePointAlongItsRadii) {
  const testing::Shape sphere = testing::icosphere(0.1, 4);
  const std::vector<Float3> normals = angle_weighted_normals(sphere.vertices, sphere.triangles);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(to_vec3(normals[i]).norm(), 1.0, 1e-6);
    EXPECT_GT(to_vec3(normals[i]).dot(to_vec3(sphere.vertices[i]).normalized()), 0.9999);
  }
}

TEST(AngleWeightedNormals, AreZeroWhereFacesCancelOut) {
  const std::vector<Float3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<TriangleIndices> both{{0, 1, 2}, {0, 2, 1}};
  for (const Float3& normal : angle_weighted_normals(corners, both)) {
    EXPECT_EQ(normal, Float3{});
  }
}

}  // namespace
}  // namespace tactus::host
