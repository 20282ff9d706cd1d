#include "host_tools/mesh/primitive_mesh.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/connected_solid.h"
#include "tests/support/primitive_points.h"

namespace tactus::rendering {
namespace {

TEST(PrimitiveMesh, LiesOnTheSurfaceAndFacesOutward) {
  std::mt19937_64 random(33);
  for (int i = 0; i < 10; ++i) {
    for (const PrimitiveKind kind : testing::kAllPrimitives) {
      SCOPED_TRACE("seed 33, round " + std::to_string(i) + ", kind " +
                   std::to_string(static_cast<int>(kind)));
      const Primitive primitive = testing::random_primitive(kind, random);
      const host::TriangleMesh mesh = host::primitive_mesh(primitive);
      ASSERT_LE(mesh.triangles.size(), 5000U);
      for (const Float3& vertex : mesh.vertices) {
        ASSERT_NEAR(sample(primitive, to_vec3(vertex)).distance_m, 0.0, 1e-7);
      }
      for (const TriangleIndices& t : mesh.triangles) {
        const Vec3 a = to_vec3(mesh.vertices[t[0]]);
        const Vec3 b = to_vec3(mesh.vertices[t[1]]);
        const Vec3 c = to_vec3(mesh.vertices[t[2]]);
        const Vec3 normal = (b - a).cross(c - a);
        ASSERT_GT(normal.norm(), 0.0);
        const Vec3 middle = (a + b + c) / 3.0;
        ASSERT_GT(sample(primitive, middle + 1e-3 * normal.normalized()).distance_m,
                  sample(primitive, middle).distance_m);
      }
    }
  }
}

// Every edge belongs to two triangles that face the same way, so the solid angles add up.
TEST(PrimitiveMesh, IsClosed) {
  std::mt19937_64 random(34);
  for (const PrimitiveKind kind : testing::kAllPrimitives) {
    if (kind == PrimitiveKind::plane) {
      continue;
    }
    const Primitive primitive = testing::random_primitive(kind, random);
    const host::TriangleMesh mesh = host::primitive_mesh(primitive);
    const testing::Shape shape{
        .name = "mesh", .vertices = mesh.vertices, .triangles = mesh.triangles};
    const Vec3 outside = Vec3::Constant(1.0);
    EXPECT_NEAR(testing::winding_number(shape, outside), 0.0, 1e-9);
    Vec3 inside = primitive.X_WO.translation + 1e-4 * primitive.X_WO.rotation.col(1);
    if (kind == PrimitiveKind::torus) {
      inside += primitive.dimensions_m[0] * primitive.X_WO.rotation.col(0);
    }
    EXPECT_NEAR(testing::winding_number(shape, inside), 1.0, 1e-9)
        << "kind " << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace tactus::rendering
