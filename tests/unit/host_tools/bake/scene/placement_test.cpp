#include "host_tools/bake/scene/placement.h"

#include <gtest/gtest.h>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using testing::contains;
using testing::input_error;

ImportedMesh triangle() {
  return {.vertices = {{10, 0, 0}, {14, 0, 0}, {10, 2, 1}}, .triangles = {{0, 1, 2}}};
}

void expect_near(const Float3& v, const Vec3& expected) {
  EXPECT_NEAR((to_vec3(v) - expected).norm(), 0.0, 1e-7);
}

TEST(Placement, LeavesTheMeshWhereItsFileHasItByDefault) {
  const TriangleMesh mesh = place(triangle(), {});
  expect_near(mesh.vertices[1], {14, 0, 0});
}

TEST(Placement, ScalesAroundTheMeshsOwnOrigin) {
  const TriangleMesh mesh = place(triangle(), {.longest_side_m = {}, .scale = 0.01});
  expect_near(mesh.vertices[1], {0.14, 0, 0});
}

TEST(Placement, CentresTheBoxWhenItsLongestSideIsGiven) {
  const TriangleMesh mesh = place(triangle(), {.longest_side_m = 0.4});
  expect_near(mesh.vertices[0], {-0.2, -0.1, -0.05});
  expect_near(mesh.vertices[1], {0.2, -0.1, -0.05});
  expect_near(mesh.vertices[2], {-0.2, 0.1, 0.05});
}

TEST(Placement, TurnsByTheRightHandBeforeItMoves) {
  const Eigen::Quaterniond quarter_about_y(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));
  const TriangleMesh mesh = place(
      triangle(),
      {.longest_side_m = {}, .scale = 0.1, .rotation = quarter_about_y, .position_m = {1, 2, 3}});
  expect_near(mesh.vertices[0], {1, 2, 2});  // x turns to -z
  expect_near(mesh.vertices[2], {1.1, 2.2, 2});
}

TEST(Placement, MeasuresTheBoxOfTheTrianglesAlone) {
  ImportedMesh with_stray_point = triangle();
  with_stray_point.vertices.emplace_back(1000, 1000, 1000);
  const TriangleMesh mesh = place(with_stray_point, {.longest_side_m = 0.4});
  expect_near(mesh.vertices[1], {0.2, -0.1, -0.05});
}

TEST(Placement, RefusesAMeshWithoutExtentAndOneBeyondFloats) {
  ImportedMesh point = triangle();
  point.vertices.assign(3, Vec3(1, 1, 1));
  EXPECT_TRUE(
      contains(input_error([&] { place(point, {.longest_side_m = 0.1}); }), "at one place"));
  EXPECT_TRUE(contains(
      input_error([&] { place(triangle(), {.longest_side_m = {}, .scale = 1e38}); }), "too far"));
}

}  // namespace
}  // namespace tactus::host
