// The mesh of a formula: how near it is to the surface, that it has no cracks, and the refusals.
#include "host_tools/bake/formula/formula_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "host_tools/bake/formula/formula_parser.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using ::testing::HasSubstr;

rendering::Box cube_of(double half) {
  return {.lower = Vec3::Constant(-half), .upper = Vec3::Constant(half)};
}

ImportedMesh formula_mesh_of(const std::string& text, const rendering::Box& bounds,
                             const FormulaMeshPlan& plan) {
  const Formula formula = parse_formula(text);
  return mesh_formula(formula.view(), bounds, plan);
}

std::array<Vec3, 3> corners_of(const ImportedMesh& mesh, const rendering::TriangleIndices& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

double volume_of(const ImportedMesh& mesh) {
  double six = 0.0;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const auto& [a, b, c] = corners_of(mesh, t);
    six += a.dot(b.cross(c));
  }
  return six / 6.0;
}

// Returns the largest of a function over a grid of points of every triangle.
double largest_over(const ImportedMesh& mesh, const std::function<double(const Vec3&)>& function) {
  constexpr int kParts = 6;
  double largest = 0.0;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const auto& [a, b, c] = corners_of(mesh, t);
    for (int i = 0; i <= kParts; ++i) {
      for (int j = 0; i + j <= kParts; ++j) {
        largest = std::max(largest, function(a + i * (b - a) / kParts + j * (c - a) / kParts));
      }
    }
  }
  return largest;
}

// Expects that every side of a triangle is that of another one, the other way round.
void expect_closed(const ImportedMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++sides[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    ASSERT_TRUE(back != sides.end() && back->second == count) << side.first << " " << side.second;
  }
}

// Units of 30 mm.
constexpr double kUnit_m = 0.03;

TEST(FormulaMesh, OfRoundShapesIsWithinTheTolerance) {
  struct Round {
    const char* text;
    std::function<double(const Vec3&)> distance;
    double volume;
  };
  const double pi = std::numbers::pi;
  const std::array shapes{
      Round{"sphere(1)", [](const Vec3& p) { return p.norm() - 1.0; }, 4.0 / 3.0 * pi},
      Round{"(x^2 + y^2 + z^2 - 1)^3", [](const Vec3& p) { return p.norm() - 1.0; },
            4.0 / 3.0 * pi},
      Round{"torus(1, 0.3)",
            [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()) - 0.3; },
            2.0 * pi * pi * 0.09},
  };
  for (const Round& shape : shapes) {
    for (const double tolerance_m : {1e-3, 1e-4}) {
      const ImportedMesh mesh = formula_mesh_of(shape.text, cube_of(2.0),
                                                {.tolerance_m = tolerance_m, .unit_m = kUnit_m});
      const double off =
          largest_over(mesh, [&](const Vec3& p) { return std::abs(shape.distance(p)); });
      // A triangle is farthest from the surface in its middle, and hardly farther elsewhere.
      EXPECT_LE(off * kUnit_m, 1.3 * tolerance_m) << shape.text;
      EXPECT_NEAR(volume_of(mesh), shape.volume, shape.volume * 8.0 * tolerance_m / kUnit_m);
      EXPECT_TRUE(mesh.notes.empty()) << shape.text;
      expect_closed(mesh);
    }
  }
}

TEST(FormulaMesh, KeepsEdgesAndCornersSharp) {
  const ImportedMesh box =
      formula_mesh_of("box(2, 1, 0.5)", cube_of(2.0), {.tolerance_m = 1e-6, .unit_m = kUnit_m});
  EXPECT_NEAR(volume_of(box), 1.0, 1e-9);
  EXPECT_LT(box.triangles.size(), 5000U);
  expect_closed(box);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.25, 0.25}) {
        const Vec3 corner(x, y, z);
        EXPECT_TRUE(std::ranges::any_of(box.vertices, [&](const Vec3& v) {
          return (v - corner).norm() < 1e-9;
        })) << corner.transpose();
      }
    }
  }
  const ImportedMesh cylinder =
      formula_mesh_of("cylinder(1, 2)", cube_of(2.0), {.tolerance_m = 2e-5, .unit_m = kUnit_m});
  EXPECT_NEAR(volume_of(cylinder), 2.0 * std::numbers::pi, 0.01);
  expect_closed(cylinder);
}

// The fine cells about a small ball are beside large ones.
TEST(FormulaMesh, HasNoCracksWhereSmallCellsAreBesideLargeOnes) {
  const ImportedMesh mesh =
      formula_mesh_of("blend_union(sphere(1), length(x, y, z - 1.05) - 0.1, 2, 0.05)", cube_of(1.5),
                      {.tolerance_m = 5e-5, .unit_m = kUnit_m});
  EXPECT_GT(volume_of(mesh), 4.0 / 3.0 * std::numbers::pi);
  expect_closed(mesh);
}

TEST(FormulaMesh, ReachesSingularPoints) {
  for (const char* const text : {"heart()", "cone(1, 1.5)"}) {
    const Formula formula = parse_formula(text);
    const ImportedMesh mesh =
        mesh_formula(formula.view(), cube_of(1.8), {.tolerance_m = 1e-4, .unit_m = kUnit_m});
    expect_closed(mesh);
    EXPECT_GT(volume_of(mesh), 1.0) << text;
  }
}

TEST(FormulaMesh, FindsSheetsThinnerThanACell) {
  const ImportedMesh mesh =
      formula_mesh_of("box(2, 2, 0.02)", cube_of(2.0), {.tolerance_m = 1e-5, .unit_m = kUnit_m});
  EXPECT_NEAR(volume_of(mesh), 0.08, 1e-9);
  EXPECT_TRUE(mesh.notes.empty());
  expect_closed(mesh);
}

TEST(FormulaMesh, EndsOpenAtTheBounds) {
  const ImportedMesh mesh =
      formula_mesh_of("z - 0.2*sin(3*x)", cube_of(1.0), {.tolerance_m = 1e-3});
  const double off = largest_over(
      mesh, [](const Vec3& p) { return std::abs(p.z() - 0.2 * std::sin(3.0 * p.x())); });
  EXPECT_LE(off, 1.5e-3);
  for (const rendering::TriangleIndices& t : mesh.triangles) {
    const auto& [a, b, c] = corners_of(mesh, t);
    EXPECT_GE((b - a).cross(c - a).z(), 0.0);
  }
}

TEST(FormulaMesh, SaysWhereTheSurfaceIsTooFine) {
  const ImportedMesh mesh =
      formula_mesh_of("intersection(x*y*z, sphere(1))", cube_of(1.2), {.tolerance_m = 1e-3});
  ASSERT_FALSE(mesh.notes.empty());
  EXPECT_THAT(mesh.notes.front(), HasSubstr("nearer to each other than"));
}

TEST(FormulaMesh, RefusesWhatIsNoSurfaceAndWhatNeedsTooManyTriangles) {
  EXPECT_THAT(testing::input_error([] { formula_mesh_of("x^2", cube_of(1.0), {}); }),
              HasSubstr("never changes its sign"));
  EXPECT_THAT(testing::input_error([] { formula_mesh_of("x^2 + 1", cube_of(1.0), {}); }),
              HasSubstr("above 0 everywhere"));
  EXPECT_THAT(testing::input_error([] {
                formula_mesh_of("sphere(1)", cube_of(2.0),
                                {.tolerance_m = 1e-5, .most_triangles = 10'000});
              }),
              HasSubstr("write a larger tolerance_m"));
}

TEST(FormulaMesh, TellsWhatItIsDoing) {
  std::size_t steps = 0;
  formula_mesh_of("sphere(1)", cube_of(2.0),
                  {.tolerance_m = 1e-3, .progress = [&](std::size_t) { ++steps; }});
  EXPECT_GE(steps, 2U);
}

}  // namespace
}  // namespace tactus::host
