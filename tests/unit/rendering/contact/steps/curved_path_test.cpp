// Lengthened moves about a vertex, an edge and along a crease, against plane geometry.
#include "rendering/contact/curved_path.h"

#include <gtest/gtest.h>

#include "tests/unit/rendering/contact/steps/add_plane.h"

namespace tactus::rendering {
namespace {

// A sphere that stands on a feature at the origin, its centre at y = the radius, and a tool below
// and beside it.
class CurvedPathTest : public ::testing::Test {
 protected:
  static constexpr double kRadius_m = 0.002;
  static constexpr double kDepth_m = 0.0003;
  static constexpr double kAside_m = 0.0002;

  void stand_on(Feature feature) {
    ContactPlane contact{.plane = {.normal = Vec3::UnitY(), .offset = kRadius_m}};
    contact.nearest = {.distance = kRadius_m, .normal = Vec3::UnitY(), .feature = feature};
    contact.nearest.edge = 0;
    testing::add_plane(planes_, contact, rest_.flags);
    rest_.planes[0] = contact;
    rest_.pressure_m[0] = kDepth_m;
    rest_.plane_count = 1;
  }
  Vec3 lengthened(const Vec3& move, const Vec3& h) {
    return path_.lengthen(move, p_, h, rest_, planes_, ridge_);
  }

  const Triangle ridge_{{0.0, 0.0, -0.01}, {0.0, 0.0, 0.01}, {0.01, -0.01, 0.0}};  // edge 0 along z
  ContactPlanes planes_;
  ProxyRest rest_;
  CurvedPath path_;
  const Vec3 p_{0.0, kRadius_m, 0.0};
};

TEST_F(CurvedPathTest, OverAVertexTheMoveEndsOnTheRayThroughTheTool) {
  stand_on(Feature::vertex);
  const Vec3 h{kAside_m, kRadius_m - kDepth_m, 0.0};
  const Vec3 end = p_ + lengthened({kAside_m, 0.0, 0.0}, h);
  EXPECT_NEAR(end.y(), kRadius_m, 1e-15);
  EXPECT_LT(end.cross(h).norm(), 1e-12 * end.norm()) << end.transpose();
}

TEST_F(CurvedPathTest, OverAnEdgeOnlyThePartAcrossItIsLengthened) {
  stand_on(Feature::edge);
  const Vec3 h{kAside_m, kRadius_m - kDepth_m, kAside_m};
  const Vec3 move = lengthened({kAside_m, 0.0, kAside_m}, h);
  EXPECT_NEAR(move.z(), kAside_m, 1e-15);
  EXPECT_NEAR(move.x(), kAside_m / (1.0 - kDepth_m / kRadius_m), 1e-12);
}

TEST_F(CurvedPathTest, OnAFaceTheMoveIsAsItIs) {
  stand_on(Feature::face);
  const Vec3 move{kAside_m, 0.0, 0.0};
  EXPECT_EQ(lengthened(move, {kAside_m, kRadius_m - kDepth_m, 0.0}), move);
}

TEST_F(CurvedPathTest, ASecondMoveIsLengthenedOnlyIfItEndsNearerToTheTool) {
  stand_on(Feature::vertex);
  const Vec3 h{kAside_m, kRadius_m - kDepth_m, 0.0};
  const Vec3 move{kAside_m, 0.0, 0.0};
  EXPECT_NE(lengthened(move, h), move);
  EXPECT_EQ(lengthened(move, h), move);
}

TEST_F(CurvedPathTest, NoMoveIsLengthenedThroughAnotherPlane) {
  stand_on(Feature::vertex);
  const Vec3 move{kAside_m, 0.0, 0.0};
  testing::add_plane(planes_, {.plane = {.normal = -Vec3::UnitX(), .offset = -kAside_m}},
                     rest_.flags);
  EXPECT_EQ(lengthened(move, {kAside_m, kRadius_m - kDepth_m, 0.0}), move);
}

TEST_F(CurvedPathTest, AlongACreaseTheLastTwoMovesGiveTheRatio) {
  stand_on(Feature::vertex);
  rest_.planes[1] = rest_.planes[0];
  rest_.planes[0].plane.normal = Vec3{1.0, 1.0, 0.0}.normalized();
  rest_.planes[1].plane.normal = Vec3{-1.0, 1.0, 0.0}.normalized();
  rest_.plane_count = 2;
  path_.remember_crease({0.0, 0.0, 2 * kAside_m});
  const Vec3 move = lengthened({0.0, 0.0, kAside_m}, {0.0, kRadius_m - kDepth_m, 0.001});
  // Moves that halve sum to twice the next one.
  EXPECT_TRUE(move.isApprox(Vec3{0.0, 0.0, 2 * kAside_m}, 1e-12)) << move.transpose();
}

}  // namespace
}  // namespace tactus::rendering
