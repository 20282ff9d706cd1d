#include "host_tools/bake/scene/mesh_cleanup.h"

#include <gtest/gtest.h>

#include "host_tools/bake/scene/mesh_bake.h"
#include "tests/support/shapes.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::TriangleIndices;
using testing::contains;
using testing::input_error;

// Every triangle with three vertices of its own, as an STL file has them.
TriangleMesh shattered(const testing::Shape& shape) {
  TriangleMesh mesh;
  for (const TriangleIndices& t : shape.triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t v : t) {
      mesh.vertices.push_back(shape.vertices[v]);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(Weld, PutsAShatteredSphereTogether) {
  const testing::Shape sphere = testing::icosphere(0.1, 3);
  TriangleMesh mesh = shattered(sphere);
  EXPECT_EQ(weld(mesh, 0.0), 3 * sphere.triangles.size() - sphere.vertices.size());
  EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.vertices[mesh.triangles[i][k]], sphere.vertices[sphere.triangles[i][k]]);
    }
  }
}

TEST(Weld, TakesMinusZeroForZero) {
  TriangleMesh mesh{.vertices = {{0.0F, 1.0F, 2.0F}, {-0.0F, 1.0F, 2.0F}}, .triangles = {}};
  EXPECT_EQ(weld(mesh, 0.0), 1U);
}

TEST(Weld, KeepsVerticesApartThatDifferInTheLastBit) {
  TriangleMesh mesh{.vertices = {{1.0F, 0, 0}, {std::nextafter(1.0F, 2.0F), 0, 0}},
                    .triangles = {}};
  EXPECT_EQ(weld(mesh, 0.0), 0U);
}

TEST(Weld, MergesWithinTheToleranceAndNotBeyond) {
  TriangleMesh mesh{.vertices = {{0, 0, 0}, {0.9e-4F, 0, 0}, {2.1e-4F, 0, 0}, {0, 0, 0}},
                    .triangles = {{1, 2, 3}}};
  EXPECT_EQ(weld(mesh, 1e-4), 2U);
  EXPECT_EQ(mesh.vertices, (std::vector<Float3>{{0, 0, 0}, {2.1e-4F, 0, 0}}));
  EXPECT_EQ(mesh.triangles.front(), (TriangleIndices{0, 1, 0}));
}

TEST(Weld, MergesAcrossTheCellsOfItsGrid) {
  // A hair apart on either side of where cells of 1 mm meet, in all three axes.
  const float below = 0.4999e-3F;
  const float above = 0.5001e-3F;
  TriangleMesh mesh{.vertices = {{below, below, below}, {above, above, above}}, .triangles = {}};
  EXPECT_EQ(weld(mesh, 1e-3), 1U);
}

TEST(DropDegenerate, DropsRepeatedVerticesAndHeightsBelowANanometre) {
  TriangleMesh mesh{
      .vertices = {{0, 0, 0}, {0.1F, 0, 0}, {0.05F, 0, 0}, {0.05F, 5e-10F, 0}, {0.05F, 2e-9F, 0}},
      .triangles = {{0, 1, 1}, {0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  EXPECT_EQ(drop_degenerate(mesh), 3U);
  EXPECT_EQ(mesh.triangles, (std::vector<TriangleIndices>{{0, 1, 4}}));
}

TEST(DropDegenerate, KeepsDuplicatesAndSmallTrianglesOfGoodShape) {
  TriangleMesh mesh{.vertices = {{0, 0, 0}, {1e-7F, 0, 0}, {0, 1e-7F, 0}},
                    .triangles = {{0, 1, 2}, {0, 1, 2}}};
  EXPECT_EQ(drop_degenerate(mesh), 0U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(OrderVerticesByUse, LeavesOutWhatNoTriangleUses) {
  TriangleMesh mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                    .triangles = {{3, 1, 0}}};
  order_vertices_by_use(mesh);
  EXPECT_EQ(mesh.vertices, (std::vector<Float3>{{3, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(mesh.triangles.front(), (TriangleIndices{0, 1, 2}));
}

TEST(BakeMesh, CountsWhatItMergedAndDropped) {
  const testing::Shape sphere = testing::icosphere(0.1, 2);
  TriangleMesh mesh = shattered(sphere);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const BakedMesh baked = bake_mesh(mesh);
  EXPECT_EQ(baked.triangles.size(), sphere.triangles.size());
  EXPECT_EQ(baked.vertices.size(), sphere.vertices.size()) << "the dropped triangle's are gone";
  EXPECT_EQ(baked.counters.degenerate_triangles, 1U);
  EXPECT_EQ(baked.counters.welded_vertices,
            3 * sphere.triangles.size() - sphere.vertices.size() + 1);
  EXPECT_TRUE(rendering::check_mesh(baked.baked_view()).has_value());
}

TEST(BakeMesh, RefusesWhatCannotBeTouched) {
  const std::vector<Float3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Float3> bad{{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
  const std::vector<TriangleIndices> triangle{{0, 1, 2}};
  EXPECT_TRUE(contains(input_error([&] { bake_mesh(bad, triangle); }), "vertex 2 is not finite"));
  EXPECT_TRUE(
      contains(input_error([&] { bake_mesh(corners, std::vector<TriangleIndices>{{0, 1, 3}}); }),
               "triangle 0 names vertex 3 of 3"));
  EXPECT_TRUE(
      contains(input_error([&] { bake_mesh(corners, std::vector<TriangleIndices>{{0, 1, 1}}); }),
               "no triangle with an area is left (1 dropped)"));
  EXPECT_TRUE(contains(input_error([&] { bake_mesh(corners, {}); }), "no triangle"));
}

}  // namespace
}  // namespace tactus::host
