// The planes at a proxy on an implicit surface, against plane geometry.
#include "rendering/contact/implicit_planes.h"

#include <gtest/gtest.h>

#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

// The corner x, y, z >= 0 and a tool behind it, on a surface of which a unit is 50 mm.
class ImplicitPlanesTest : public ::testing::Test {
 protected:
  static constexpr double kScale_m = 0.05;

  ImplicitPlanesTest() {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(planes_.add({.normal = Vec3::Unit(axis), .offset = 0.0}));
    }
  }
  ImplicitPush push(const Vec3& h) { return planes_.push(h, sphere_.surface); }

  const FormulaSurface sphere_{"sphere(1)", kScale_m};
  ImplicitPlanes planes_;
  const Vec3 tool_{-1.0, -2.0, -2.0};
};

TEST_F(ImplicitPlanesTest, ACornerPushesByTheToolsDepthBehindEachPlane) {
  const ImplicitPush corner = push(tool_);
  EXPECT_EQ(corner.projection.active_count, 3U);
  EXPECT_TRUE(corner.projection.point.isZero(1e-15));
  EXPECT_NEAR(corner.depth_m, 5.0 * kScale_m, 1e-15);
  EXPECT_TRUE(corner.normal_W.isApprox(Vec3{1.0, 2.0, 2.0} / 3.0, 1e-12));
}

TEST_F(ImplicitPlanesTest, AToolInFrontOfThePlanesIsNotPushed) {
  const ImplicitPush none = push({1.0, 2.0, 3.0});
  EXPECT_EQ(none.projection.active_count, 0U);
  EXPECT_EQ(none.normal_W, Vec3::Zero());
  EXPECT_EQ(none.depth_m, 0.0);
}

TEST_F(ImplicitPlanesTest, APlaneThatBoundsLessThanAnEqualOneIsNotAdded) {
  EXPECT_FALSE(planes_.add({.normal = Vec3::UnitX(), .offset = -0.1}));
  EXPECT_TRUE(planes_.add({.normal = Vec3::UnitX(), .offset = 0.1}));
  EXPECT_EQ(planes_.size(), 4U);
}

TEST_F(ImplicitPlanesTest, AFifthPlaneReplacesTheOneThatDoesNotPush) {
  ASSERT_TRUE(planes_.add({.normal = Vec3::Ones().normalized(), .offset = -0.5}));
  ASSERT_EQ(push(tool_).projection.active_count, 3U);
  ASSERT_TRUE(planes_.add({.normal = Vec3::UnitX(), .offset = 0.25}));
  EXPECT_EQ(planes_.size(), 4U);
  EXPECT_TRUE(push(tool_).projection.point.isApprox(Vec3{0.25, 0.0, 0.0}, 1e-12));
  // Now the first one is idle.
  ASSERT_TRUE(planes_.add({.normal = Vec3::UnitY(), .offset = 0.5}));
  EXPECT_TRUE(push(tool_).projection.point.isApprox(Vec3{0.25, 0.5, 0.0}, 1e-12));
}

TEST_F(ImplicitPlanesTest, ClearRemovesAll) {
  planes_.clear();
  EXPECT_EQ(planes_.size(), 0U);
  EXPECT_EQ(push(tool_).projection.point, tool_);
}

TEST_F(ImplicitPlanesTest, TheTangentPlaneLiesAtTheRestHeight) {
  const ImplicitSample here{.point = {0.0, 1.001, 0.0}, .normal = Vec3::UnitY(), .height = 0.001};
  const Plane plane = tangent_plane(sphere_.surface, here);
  EXPECT_EQ(plane.normal, Vec3::UnitY());
  EXPECT_NEAR((plane.offset - 1.0) * kScale_m, kImplicitRest_m, 1e-15);
}

TEST_F(ImplicitPlanesTest, AWallGivesItsTangentPlaneAtTheRestHeight) {
  ImplicitField field(sphere_.surface, 1.0, 1000);
  const Plane plane = blocking_plane(field, {0.6, 0.8, 0.0}, Vec3::UnitZ());
  EXPECT_TRUE(plane.normal.isApprox(Vec3{0.6, 0.8, 0.0}, 1e-12));
  EXPECT_NEAR((plane.offset - 1.0) * kScale_m, kImplicitRest_m, 1e-15);
}

TEST_F(ImplicitPlanesTest, ASingularPointGivesAPlaneAcrossTheWayFromTheTool) {
  const FormulaSurface line("x^2 + y^2 - 0 * z");  // its gradient is zero on the z axis
  ImplicitField field(line.surface, 1.0, 1000);
  const Plane plane = blocking_plane(field, {0.0, 0.0, 0.5}, {0.0, 3.0, 4.0});
  EXPECT_TRUE(plane.normal.isApprox(Vec3{0.0, 0.6, 0.8}, 1e-12));
  EXPECT_NEAR(plane.offset, 0.4 + kImplicitRest_m, 1e-15);
}

}  // namespace
}  // namespace tactus::rendering
