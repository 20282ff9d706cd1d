#include "host_tools/bake/scene/mesh_cleanup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/world/world.h"
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

// Two sheets of 3 x 2 cells side by side, with a gap between their rims.
TriangleMesh sheets_with_gap(float gap_m) {
  constexpr std::uint32_t kRows = 3;
  TriangleMesh mesh;
  for (const float side : {-1.0F, 1.0F}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t row = 0; row <= kRows; ++row) {
      for (const float out : {0.0F, 0.01F, 0.02F}) {
        mesh.vertices.push_back(
            {side * (0.5F * gap_m + out), 0.0F, 0.01F * static_cast<float>(row)});
      }
    }
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t k = 0; k < 2; ++k) {
        const std::uint32_t a = first + 3 * row + k;
        const std::uint32_t b = a + 1;
        mesh.triangles.push_back(side > 0.0F ? TriangleIndices{a, a + 3, b}
                                             : TriangleIndices{a, b, a + 3});
        mesh.triangles.push_back(side > 0.0F ? TriangleIndices{b, a + 3, b + 3}
                                             : TriangleIndices{b, b + 3, a + 3});
      }
    }
  }
  return mesh;
}

TEST(WeldRims, ClosesAGapNarrowerThanTheContactMarginAndNoOther) {
  EXPECT_EQ(bake_mesh(sheets_with_gap(3e-7F)).counters.open_edges, 14U);
  EXPECT_EQ(bake_mesh(sheets_with_gap(3e-7F)).counters.welded_vertices, 4U);
  EXPECT_EQ(bake_mesh(sheets_with_gap(2e-6F)).counters.open_edges, 20U);
  TriangleMesh ball{.vertices = testing::icosphere(1e-6, 2).vertices,
                    .triangles = testing::icosphere(1e-6, 2).triangles};
  EXPECT_EQ(weld_rims(ball), 0U);
}

// The point strokes across the gap and over the seams that end at it, 2.5 mm deep.
TEST(WeldRims, APointFeelsNoWallAtANarrowGap) {
  const BakedMesh baked = bake_mesh(sheets_with_gap(3e-7F));
  rendering::Object object;
  object.mesh = baked.view();
  object.method = rendering::ContactMethod::god_object;
  object.material.stiffness_N_per_m = 1000.0;
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.0}));
  for (const double z_m : {0.0037, 0.01, 0.0151, 0.02}) {
    for (int i = 0; i < 200; ++i) {
      const double y_m = std::max(-0.0025, 0.001 - 1e-4 * i);
      const double x_m = -0.002 + 2e-5 * i;
      const rendering::Touch touch = world->touch({.p_W = {x_m, y_m, z_m}});
      ASSERT_LT(std::abs(touch.force_W.x()), 1e-3) << x_m << " " << z_m;
      ASSERT_NEAR(touch.force_W.y(), 1000.0 * std::max(0.0, -y_m), 2e-3) << x_m << " " << z_m;
    }
    world->touch({.p_W = {0.0, 0.01, z_m}});
    world->touch({.p_W = {-0.002, 0.01, z_m}});
  }
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
