#include "host_tools/bake/scene/corner_normals.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/rendering/detail/shaded_solid.h"

namespace tactus::rendering {
namespace {

using testing::ShadedSolid;

Vec3 normal_of(const host::BakedMesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t k) {
    return to_vec3(mesh.vertices[mesh.triangles[triangle][k]]);
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

TEST(OctahedralNormal, HoldsEveryDirectionToSeventyMicroradians) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE(::testing::Message() << "seed " << kSeed);
  std::mt19937 engine(kSeed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 n = Vec3(normal(engine), normal(engine), normal(engine)).normalized();
    ASSERT_LE((decode(encode(n)) - n).norm(), 7e-5) << n.transpose();
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 n = sign * Vec3::Unit(axis);
      EXPECT_EQ(decode(encode(n)), n);
    }
  }
}

TEST(CornerNormals, ABoxStaysSharp) {
  const ShadedSolid box(testing::box({0.04, 0.05, 0.06}), 40.0, {});
  for (std::size_t t = 0; t < box.corners().size(); ++t) {
    for (const OctahedralNormal& corner : box.corners()[t]) {
      EXPECT_LE((decode(corner) - normal_of(box.mesh(), t)).norm(), 1e-4);
    }
  }
}

TEST(CornerNormals, APrismIsRoundAboutItsAxisAndSharpAtItsRims) {
  const ShadedSolid prism(testing::prism(16, 0.02, 0.04), 40.0, {});
  for (std::size_t t = 0; t < prism.corners().size(); ++t) {
    const Vec3 face = normal_of(prism.mesh(), t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n = decode(prism.corners()[t][k]);
      Vec3 radial = to_vec3(prism.mesh().vertices[prism.mesh().triangles[t][k]]);
      radial.z() = 0.0;
      const bool is_cap = std::abs(face.z()) > 0.5;
      EXPECT_LE((n - (is_cap ? face : Vec3{radial.normalized()})).norm(), 1e-4);
    }
  }
}

TEST(CornerNormals, BelowTheirAngleEdgesStaySharp) {
  const ShadedSolid prism(testing::prism(16, 0.02, 0.04), 22.0, {});  // its faces meet at 22.5
  for (std::size_t t = 0; t < prism.corners().size(); ++t) {
    for (const OctahedralNormal& corner : prism.corners()[t]) {
      EXPECT_LE((decode(corner) - normal_of(prism.mesh(), t)).norm(), 1e-4);
    }
  }
}

TEST(CornerNormals, OfASphereAreItsRadii) {
  const ShadedSolid sphere(testing::icosphere(0.05, 3), 40.0, {});
  for (std::size_t t = 0; t < sphere.corners().size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = to_vec3(sphere.mesh().vertices[sphere.mesh().triangles[t][k]]);
      EXPECT_LE((decode(sphere.corners()[t][k]) - p.normalized()).norm(), 0.01);
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
