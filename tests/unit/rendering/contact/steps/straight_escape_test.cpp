// Straight sweeps of a sphere above a box, against plane geometry.
#include "rendering/contact/straight_escape.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

// A sphere that holds half a millimetre above the top of a box about the origin.
class StraightEscapeTest : public ::testing::Test {
 protected:
  static constexpr double kRadius_m = 0.002;
  static constexpr double kHalf_m = 0.0078125;  // exact as a float

  StraightEscapeTest() {
    EXPECT_TRUE(scene_->set({&box_.object(), 1}));
    scene_->begin_tick(0.001, 0.001);
    candidates_->start_tick_budget(units_of(1e6));
    state_.p_W = {0.003, kHalf_m + kRadius_m + 0.0005, 0.001};
    rest_.plane_count = 1;
    rest_.normal_W = Vec3::UnitY();
  }
  void escape_to(const Vec3& h) { escape_overfull_planes(near_, h, proxy_); }

  const testing::Solid box_{testing::box(2 * kHalf_m * Vec3::Ones()), Sides::one,
                            testing::kSlippery};
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  std::unique_ptr<CandidateSet> candidates_ = std::make_unique<CandidateSet>();
  const ContactMargins margins_{kRadius_m};
  const NearbySurfaces near_{.scene = *scene_, .margins = margins_, .candidates = *candidates_};
  ProxyState state_;
  ContactPlanes planes_;
  ProxyRest rest_;
  const MovingProxy proxy_{.state = state_, .planes = planes_, .rest = rest_};
};

TEST_F(StraightEscapeTest, ASweepToAToolInFreeSpaceArrives) {
  const Vec3 h = state_.p_W + Vec3{0.001, 0.02, 0.0};
  sweep_to_tool(near_, h, state_);
  EXPECT_EQ(state_.p_W, h);
  EXPECT_EQ(state_.last_contact.object, kNoObject);
}

TEST_F(StraightEscapeTest, ASweepToAToolInTheBoxEndsInTheMarginOfTheTop) {
  const Vec3 start = state_.p_W;
  sweep_to_tool(near_, {start.x(), 0.0, start.z()}, state_);
  EXPECT_EQ(state_.p_W.x(), start.x());
  EXPECT_GE(state_.p_W.y() - kHalf_m, margins_.sphere.inner_m);
  EXPECT_LE(state_.p_W.y() - kHalf_m, margins_.sphere.rest_m);
  EXPECT_EQ(state_.last_contact.object, 0U);
}

TEST_F(StraightEscapeTest, AProxyIsLetGoOnlyOfMorePlanesThanAreKept) {
  const Vec3 start = state_.p_W;
  const Vec3 h = start + Vec3{0.0, 0.02, 0.0};
  escape_to(h);
  EXPECT_EQ(state_.p_W, start);
  EXPECT_EQ(rest_.plane_count, 1U);
  rest_.flags = kTouchPlanesOverflow;
  escape_to(h);
  EXPECT_EQ(state_.p_W, h);
  EXPECT_EQ(rest_.plane_count, 0U);
  EXPECT_EQ(rest_.normal_W, Vec3::Zero());
}

TEST_F(StraightEscapeTest, AProxyThatHasMovedInThisTickStays) {
  const Vec3 start = state_.p_W;
  rest_.flags = kTouchPlanesOverflow;
  rest_.sub_goals = 1;
  escape_to(start + Vec3{0.0, 0.02, 0.0});
  EXPECT_EQ(state_.p_W, start);
}

TEST_F(StraightEscapeTest, AProxyThatDoesNotArriveStaysInContact) {
  rest_.flags = kTouchPlanesOverflow;
  escape_to(Vec3::Zero());
  EXPECT_EQ(rest_.plane_count, 1U);
}

}  // namespace
}  // namespace tactus::rendering
