// The closed forms against sums over cubes of the insides, and against meshes that are made finer.
#include "host_tools/bake/body/primitive_mass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/primitive_points.h"
#include "tests/support/share.h"
#include "tests/unit/host_tools/bake/body/lathe.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Primitive;
using rendering::PrimitiveKind;
using testing::contains;
using testing::input_error;

constexpr double kClay_kg_per_m3 = 1234.0;

Primitive in_its_own_frame(Primitive primitive) {
  primitive.X_WO = {};
  return primitive;
}

// Adds up small cubes whose middles are inside, `side` of them along each side of the bounds.
MassProperties sum_of_cubes(const Primitive& primitive, int side) {
  const rendering::Bounds bounds = rendering::bounds(primitive);
  const Vec3 step = (bounds.upper_W - bounds.lower_W) / side;
  const double mass = kClay_kg_per_m3 * step.prod();
  MassProperties sum;
  Mat3 second = Mat3::Zero();
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        const Vec3 p = bounds.lower_W + step.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
        if (testing::inside(primitive, p)) {
          sum.mass_kg += mass;
          sum.center_O += mass * p;
          second += mass * p * p.transpose();
        }
      }
    }
  }
  sum.center_O /= sum.mass_kg;
  second -= sum.mass_kg * sum.center_O * sum.center_O.transpose();
  sum.inertia_C = second.trace() * Mat3::Identity() - second;
  return sum;
}

// Returns the largest relative difference; lengths are compared with the size of the body.
double mass_difference(const MassProperties& a, const MassProperties& b) {
  const double inertia = b.inertia_C.norm();
  const double size = std::sqrt(inertia / b.mass_kg);
  return std::max({std::abs(a.mass_kg - b.mass_kg) / b.mass_kg,
                   (a.center_O - b.center_O).norm() / size,
                   (a.inertia_C - b.inertia_C).norm() / inertia});
}

// Under sanitizers the cubes are larger, and so is what they miss.
TEST(PrimitiveMass, IsTheSumOfSmallCubesInside) {
  const int side = testing::share_of(80) < 80 ? 32 : 80;
  std::mt19937_64 random(101);
  for (const PrimitiveKind kind : testing::kAllPrimitives) {
    if (kind == PrimitiveKind::plane) {
      continue;
    }
    for (int n = 0; n < testing::part_of(3); ++n) {
      const Primitive primitive = in_its_own_frame(testing::random_primitive(kind, random));
      EXPECT_LT(mass_difference(primitive_mass_properties(primitive, kClay_kg_per_m3),
                                sum_of_cubes(primitive, side)),
                0.8 / side)
          << static_cast<int>(kind);
    }
  }
}

using Profile = std::vector<Eigen::Vector2d>;

void add_arc(Profile& profile, const Eigen::Vector2d& middle, double radius, double from, double to,
             std::uint32_t pieces) {
  for (std::uint32_t k = 0; k <= pieces; ++k) {
    const double angle = from + (to - from) * k / pieces;
    profile.emplace_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
}

constexpr double kQuarter = std::numbers::pi / 2.0;

Profile profile_of(const Primitive& primitive, std::uint32_t pieces) {
  const double a = primitive.dimensions_m[0];
  const double b = primitive.dimensions_m[1];
  Profile profile;
  switch (primitive.kind) {
    case PrimitiveKind::sphere:
      add_arc(profile, {0.0, 0.0}, a, -kQuarter, kQuarter, pieces);
      break;
    case PrimitiveKind::cylinder:
      profile = {{0.0, -b}, {a, -b}, {a, b}, {0.0, b}};
      break;
    case PrimitiveKind::capsule:
      add_arc(profile, {0.0, -b}, a, -kQuarter, 0.0, pieces);
      add_arc(profile, {0.0, b}, a, 0.0, kQuarter, pieces);
      break;
    case PrimitiveKind::cone:
      profile = {{0.0, 0.0}, {a, 0.0}, {0.0, b}};
      break;
    default:
      add_arc(profile, {a, 0.0}, b, 0.0, 4.0 * kQuarter, pieces);
      profile.back() = profile.front();
      return profile;
  }
  profile.front().x() = 0.0;
  profile.back().x() = 0.0;
  return profile;
}

MassProperties of_turned(const Primitive& primitive, std::uint32_t sides) {
  const testing::PreciseMesh mesh =
      testing::turned_profile(profile_of(primitive, sides / 2), sides);
  return mesh_mass_properties(mesh.vertices, mesh.triangles, kClay_kg_per_m3);
}

TEST(PrimitiveMass, IsTheLimitOfMeshesWhoseErrorFallsAsTheSquareOfTheirEdges) {
  std::mt19937_64 random(103);
  for (const PrimitiveKind kind :
       {PrimitiveKind::sphere, PrimitiveKind::cylinder, PrimitiveKind::capsule, PrimitiveKind::cone,
        PrimitiveKind::torus}) {
    const Primitive primitive = in_its_own_frame(testing::random_primitive(kind, random));
    const MassProperties exact = primitive_mass_properties(primitive, kClay_kg_per_m3);
    const double coarse = mass_difference(of_turned(primitive, 64), exact);
    const double fine = mass_difference(of_turned(primitive, 128), exact);
    EXPECT_LT(fine, 0.003) << static_cast<int>(kind);
    EXPECT_NEAR(coarse / fine, 4.0, 0.05) << static_cast<int>(kind);
  }
}

TEST(PrimitiveMass, OfABoxIsThatOfItsMesh) {
  const Primitive box{.kind = PrimitiveKind::box, .dimensions_m = {0.5, 1.0, 1.5}};
  const MassProperties properties = primitive_mass_properties(box, 2.0);
  EXPECT_DOUBLE_EQ(properties.mass_kg, 12.0);
  EXPECT_NEAR((properties.inertia_C.diagonal() - Vec3(13.0, 10.0, 5.0)).norm(), 0.0, 1e-14);
}

TEST(PrimitiveMass, OfAFlatCapsuleIsThatOfItsSphere) {
  const Primitive capsule{.kind = PrimitiveKind::capsule, .dimensions_m = {0.02, 1e-12}};
  const Primitive sphere{.kind = PrimitiveKind::sphere, .dimensions_m = {0.02}};
  EXPECT_LT(mass_difference(primitive_mass_properties(capsule, kClay_kg_per_m3),
                            primitive_mass_properties(sphere, kClay_kg_per_m3)),
            1e-9);
}

TEST(PrimitiveMass, IgnoresThePose) {
  Primitive cone{.kind = PrimitiveKind::cone, .dimensions_m = {0.02, 0.05}};
  const MassProperties before = primitive_mass_properties(cone, kClay_kg_per_m3);
  cone.X_WO.translation = {1.0, 2.0, 3.0};
  EXPECT_EQ(primitive_mass_properties(cone, kClay_kg_per_m3).center_O, before.center_O);
  EXPECT_DOUBLE_EQ(before.center_O.y(), 0.0125);
}

TEST(PrimitiveMass, RefusesWhatHasNoVolume) {
  const auto message = [](const Primitive& primitive, double density) {
    return input_error([&] { primitive_mass_properties(primitive, density); });
  };
  EXPECT_TRUE(
      contains(message({.kind = PrimitiveKind::plane}, kClay_kg_per_m3), "a plane has no end"));
  EXPECT_TRUE(
      contains(message({.kind = PrimitiveKind::sphere, .dimensions_m = {0.0}}, kClay_kg_per_m3),
               "a dimension of the sphere is wrong"));
  EXPECT_TRUE(contains(
      message({.kind = PrimitiveKind::torus, .dimensions_m = {0.01, 0.02}}, kClay_kg_per_m3),
      "tube thinner than its ring"));
  EXPECT_TRUE(contains(message({.kind = PrimitiveKind::sphere, .dimensions_m = {0.1}}, 0.0),
                       "the density is 0"));
}

}  // namespace
}  // namespace tactus::host
