// Masses of meshes against closed forms, sums over cubes, the parallel-axis theorem and their
// parts.
#include "host_tools/bake/body/mass_properties.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "tests/support/connected_solid.h"
#include "tests/support/shapes.h"
#include "tests/unit/host_tools/bake/body/lathe.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::TriangleIndices;
using testing::contains;
using testing::input_error;
using testing::PreciseMesh;
using testing::Shape;

constexpr double kWood_kg_per_m3 = 700.0;

PreciseMesh precise(const Shape& shape) {
  PreciseMesh mesh{.triangles = shape.triangles};
  for (const rendering::Float3& v : shape.vertices) {
    mesh.vertices.push_back(to_vec3(v));
  }
  return mesh;
}

MassProperties mass_of(const PreciseMesh& mesh) {
  return mesh_mass_properties(mesh.vertices, mesh.triangles, kWood_kg_per_m3);
}

MassProperties mass_of(const Shape& shape) {
  return mesh_mass_properties(shape.vertices, shape.triangles, kWood_kg_per_m3);
}

std::string mass_error(const Shape& shape) {
  return input_error([&] { mass_of(shape); });
}

// The inertia about the origin, by the parallel-axis theorem.
Mat3 about_origin_of(const MassProperties& p) {
  return p.inertia_C + p.mass_kg * (p.center_O.squaredNorm() * Mat3::Identity() -
                                    p.center_O * p.center_O.transpose());
}

// Puts bodies together, through the origin.
MassProperties sum_of(std::span<const MassProperties> parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass_kg += part.mass_kg;
    sum.center_O += part.mass_kg * part.center_O;
    sum.inertia_C += about_origin_of(part);
  }
  sum.center_O /= sum.mass_kg;
  const MassProperties point{.mass_kg = sum.mass_kg, .center_O = sum.center_O};
  sum.inertia_C -= about_origin_of(point);
  return sum;
}

void expect_same(const MassProperties& a, const MassProperties& b, double share) {
  EXPECT_NEAR(a.mass_kg, b.mass_kg, share * b.mass_kg);
  const double size = std::sqrt(b.inertia_C.norm() / b.mass_kg);
  EXPECT_LT((a.center_O - b.center_O).norm(), share * size);
  EXPECT_LT((a.inertia_C - b.inertia_C).norm(), share * b.inertia_C.norm());
}

TEST(MassProperties, OfABoxAreThoseOfTheClosedForm) {
  const MassProperties box = mass_of(testing::moved(testing::box({0.25, 0.5, 0.125}), {8, 16, -4}));
  const double mass = kWood_kg_per_m3 * 0.25 * 0.5 * 0.125;
  EXPECT_NEAR(box.mass_kg, mass, 1e-13 * mass);
  EXPECT_LT((box.center_O - Vec3(8, 16, -4)).norm(), 1e-13);
  const Vec3 squares(0.0625, 0.25, 0.015625);
  const Vec3 moments = mass / 12.0 * (Vec3::Constant(squares.sum()) - squares);
  EXPECT_LT((box.inertia_C - Mat3(moments.asDiagonal())).norm(), 1e-13 * moments.norm());
}

TEST(MassProperties, MoveAndTurnWithTheMesh) {
  const PreciseMesh mesh = precise(testing::bumpy_sphere(0.05, 3, 0.2));
  const MassProperties before = mass_of(mesh);
  std::mt19937_64 random(211);
  std::normal_distribution<double> bell;
  for (const double distance : {0.0, 0.3, 100.0, 1e6}) {
    const Mat3 rotation = Eigen::Quaterniond(bell(random), bell(random), bell(random), bell(random))
                              .normalized()
                              .toRotationMatrix();
    const Vec3 offset = distance * Vec3(bell(random), bell(random), bell(random)).normalized();
    PreciseMesh moved = mesh;
    for (Vec3& v : moved.vertices) {
      v = rotation * v + offset;
    }
    const MassProperties after = mass_of(moved);
    // The places of the vertices are rounded as they move.
    const double rounding = 1e-13 + 1e-15 * distance / 0.05;
    expect_same(after,
                {.mass_kg = before.mass_kg,
                 .center_O = rotation * before.center_O + offset,
                 .inertia_C = rotation * before.inertia_C * rotation.transpose()},
                rounding);
  }
}

// A tetrahedron, turned so that it is not inside out.
PreciseMesh turned_tetrahedron(std::array<Vec3, 4> corners) {
  const Vec3& d = corners[3];
  if ((corners[0] - d).dot((corners[1] - d).cross(corners[2] - d)) < 0.0) {
    std::swap(corners[0], corners[1]);
  }
  return {.vertices = {corners.begin(), corners.end()},
          .triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
}

TEST(MassProperties, AreThoseOfThePartsTogether) {
  std::mt19937_64 random(223);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto point = [&] { return Vec3(place(random), place(random), place(random)); };
  for (int n = 0; n < 50; ++n) {
    const std::array<Vec3, 4> corners{point(), point(), point(), point()};
    const Vec3 within = 0.1 * corners[0] + 0.2 * corners[1] + 0.3 * corners[2] + 0.4 * corners[3];
    std::vector<MassProperties> parts;
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<Vec3, 4> part = corners;
      part[k] = within;
      parts.push_back(mass_of(turned_tetrahedron(part)));
    }
    expect_same(mass_of(turned_tetrahedron(corners)), sum_of(parts), 1e-10);
  }
}

TEST(MassProperties, OfSeparatePartsOfAMeshAddUp) {
  const Shape ball = testing::icosphere(0.03, 2);
  const Shape box = testing::moved(testing::box({0.02, 0.03, 0.04}), {0.1, 0.2, 0.3});
  const std::array parts{mass_of(ball), mass_of(box)};
  expect_same(mass_of(testing::joined(ball, box)), sum_of(parts), 1e-12);
}

TEST(MassProperties, LeaveOutAHollow) {
  const Shape outer = testing::icosphere(0.05, 3);
  Shape inner = testing::moved(testing::icosphere(0.02, 3), {0.01, 0, 0});
  MassProperties removed = mass_of(inner);
  removed.mass_kg = -removed.mass_kg;
  removed.inertia_C = -removed.inertia_C;
  for (TriangleIndices& t : inner.triangles) {
    std::swap(t[0], t[1]);
  }
  const std::array parts{mass_of(outer), removed};
  expect_same(mass_of(testing::joined(outer, inner)), sum_of(parts), 1e-12);
}

TEST(MassProperties, AreTheSumOfSmallCubesInside) {
  const Shape shape = testing::turned(
      testing::moved(testing::star(5, 0.05, 0.03, 0.04), {0.02, 0.01, 0.03}), {1, 2, 3}, 0.7);
  Eigen::AlignedBox3d box;
  for (const rendering::Float3& v : shape.vertices) {
    box.extend(to_vec3(v));
  }
  constexpr int kSide = 32;
  const Vec3 step = box.sizes() / kSide;
  std::vector<MassProperties> cubes;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const int row = i / kSide;
    const int layer = row / kSide;
    const Vec3 place(i % kSide + 0.5, row % kSide + 0.5, layer + 0.5);
    const Vec3 p = box.min() + step.cwiseProduct(place);
    constexpr double kHalf = 0.5;
    if (testing::winding_number(shape, p) > kHalf) {
      cubes.push_back({.mass_kg = kWood_kg_per_m3 * step.prod(), .center_O = p});
    }
  }
  expect_same(mass_of(shape), sum_of(cubes), 0.02);
}

TEST(MassProperties, OfABallApproachThoseOfTheSphereAsTheSquareOfTheEdges) {
  const double r = 0.05;
  const double mass = kWood_kg_per_m3 * 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const auto errors = [&](int subdivisions) {
    const MassProperties ball = mass_of(testing::icosphere(r, subdivisions));
    return std::array{1.0 - ball.mass_kg / mass, 1.0 - ball.inertia_C(0, 0) / (0.4 * mass * r * r)};
  };
  const auto coarse = errors(3);
  const auto fine = errors(4);
  EXPECT_LT(fine[1], 0.01);
  EXPECT_NEAR(coarse[0] / fine[0], 4.0, 0.1);
  EXPECT_NEAR(coarse[1] / fine[1], 4.0, 0.1);
}

TEST(MassProperties, TakeAWireAndAThinSheet) {
  EXPECT_NEAR(mass_of(testing::box({1e-4, 1e-4, 1.0})).mass_kg, kWood_kg_per_m3 * 1e-8,
              kWood_kg_per_m3 * 1e-8 * 1e-6);
  EXPECT_NEAR(mass_of(testing::box({0.5, 0.5, 1e-7})).mass_kg, kWood_kg_per_m3 * 2.5e-8,
              kWood_kg_per_m3 * 2.5e-8 * 1e-6);
}

TEST(MassProperties, ScaleToAGivenMass) {
  const MassProperties box = mass_of(testing::box({0.25, 0.5, 0.125}));
  const MassProperties heavy = with_mass(box, 3.0);
  EXPECT_EQ(heavy.mass_kg, 3.0);
  EXPECT_EQ(heavy.center_O, box.center_O);
  EXPECT_LT((heavy.inertia_C - 3.0 / box.mass_kg * box.inertia_C).norm(), 1e-15);
  for (const double mass : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(contains(input_error([&] { with_mass(box, mass); }), "give one above 0"));
  }
}

TEST(MassProperties, OfSolidsThatTouchAtAnEdgeAddUp) {
  // Two boxes of which the edge along z is the same two vertices.
  Shape shape = testing::box({1, 1, 1});
  const Shape other = testing::moved(shape, {1, 1, 0});
  const auto first = static_cast<std::uint32_t>(shape.vertices.size());
  const auto same = [&](std::uint32_t v) {
    const auto found = std::ranges::find(shape.vertices, other.vertices[v]);
    const auto place = static_cast<std::uint32_t>(found - shape.vertices.begin());
    return place < first ? place : first + v;
  };
  std::vector<TriangleIndices> added;
  added.reserve(other.triangles.size());
  for (const TriangleIndices& t : other.triangles) {
    added.push_back({same(t[0]), same(t[1]), same(t[2])});
  }
  shape.vertices.insert(shape.vertices.end(), other.vertices.begin(), other.vertices.end());
  shape.triangles.insert(shape.triangles.end(), added.begin(), added.end());
  EXPECT_NEAR(mass_of(shape).mass_kg, 2.0 * kWood_kg_per_m3, 1e-9);
}

TEST(MassProperties, RefuseAnOpenMeshWithItsHole) {
  Shape box = testing::box({0.1, 0.1, 0.1});
  box.triangles.pop_back();
  const std::string message = mass_error(box);
  EXPECT_TRUE(contains(message, "the mesh is open"));
  EXPECT_TRUE(contains(message, "1 hole"));
  EXPECT_TRUE(contains(message, "cap_holes_mm"));
  Shape ball = testing::icosphere(0.1, 3);
  ball.triangles.pop_back();
  ball.triangles.erase(ball.triangles.begin());
  EXPECT_TRUE(contains(mass_error(ball), "2 holes"));
}

TEST(MassProperties, RefuseAMeshThatIsWoundInconsistently) {
  Shape box = testing::box({0.1, 0.1, 0.1});
  std::swap(box.triangles[0][0], box.triangles[0][1]);
  EXPECT_TRUE(contains(mass_error(box), "at 3 edges of the mesh triangles face opposite ways"));
}

TEST(MassProperties, RefuseATriangleThatIsThereTwice) {
  EXPECT_TRUE(contains(mass_error(testing::doubled(testing::box({1, 1, 1}))), "there twice"));
}

TEST(MassProperties, RefuseAMeshThatIsInsideOut) {
  Shape box = testing::box({0.1, 0.1, 0.1});
  for (TriangleIndices& t : box.triangles) {
    std::swap(t[0], t[1]);
  }
  EXPECT_TRUE(contains(mass_error(box), "its volume is -0.001 m^3; write flip = true"));
}

TEST(MassProperties, RefuseAMeshWithoutAVolume) {
  Shape sheet = testing::height_field(0.1, 10, 0.01);
  const std::vector<TriangleIndices> front = sheet.triangles;
  for (const TriangleIndices& t : front) {
    sheet.triangles.push_back({t[1], t[0], t[2]});
  }
  EXPECT_TRUE(contains(mass_error(sheet), "encloses no volume"));
  EXPECT_TRUE(contains(mass_error(testing::moved(sheet, {5, 7, 9})), "encloses no volume"));
  EXPECT_TRUE(contains(input_error([] { mass_of(Shape{}); }), "encloses no volume"));
}

TEST(MassProperties, RefuseAHollowThatReachesOutsideItsBody) {
  // The volume is above 0, but the far part of negative mass makes an inertia that no body has.
  const Shape ball = testing::icosphere(0.05, 2);
  Shape inside_out = testing::moved(testing::icosphere(0.03, 2), {0.5, 0, 0});
  for (TriangleIndices& t : inside_out.triangles) {
    std::swap(t[0], t[1]);
  }
  EXPECT_TRUE(contains(mass_error(testing::joined(ball, inside_out)), "the mesh bounds no solid"));
}

TEST(MassProperties, RefuseNumbersThatAreNone) {
  Shape box = testing::box({1, 1, 1});
  EXPECT_TRUE(
      contains(input_error([&] { mesh_mass_properties(box.vertices, box.triangles, -1.0); }),
               "the density is -1 kg/m^3"));
  box.vertices[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(contains(mass_error(box), "vertex 2 is not finite"));
  box.vertices[2].y = 0;
  box.triangles[1][2] = 99;
  EXPECT_TRUE(contains(mass_error(box), "triangle 1 names vertex 99 of 8"));
}

}  // namespace
}  // namespace tactus::host
