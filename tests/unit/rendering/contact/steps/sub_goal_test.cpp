// The end of a proxy's next move, in free space, on a plane and on a vertex, against plane
// geometry.
#include "rendering/contact/sub_goal.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/materials.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/contact/steps/add_plane.h"

namespace tactus::rendering {
namespace {

// A proxy at the origin above a tool. Object 0, which is rough, gives the planes.
class SubGoalTest : public ::testing::Test {
 protected:
  static constexpr double kStatic = 0.6;
  static constexpr double kDynamic = 0.4;
  static constexpr double kRadius_m = 0.002;
  static constexpr double kDepth_m = 0.0003;

  SubGoalTest() { EXPECT_TRUE(scene_->set({&box_.object(), 1})); }

  void hold_on(const Vec3& normal, Feature feature = Feature::face) {
    const Nearest nearest{.distance = kRadius_m, .normal = normal, .feature = feature};
    testing::add_plane(planes_, {.plane = {.normal = normal, .offset = 0.0}, .nearest = nearest},
                       rest_.flags);
  }
  SubGoal choose(const Vec3& h) {
    return chooser_.choose({.near = near_, .factors = factors_, .h_W = h},
                           {.state = state_, .planes = planes_, .rest = rest_});
  }

  testing::Solid box_{testing::box({0.01, 0.01, 0.01}), Sides::one, testing::kRough};
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  std::unique_ptr<CandidateSet> candidates_ = std::make_unique<CandidateSet>();
  const ContactMargins margins_{kRadius_m};
  const NearbySurfaces near_{.scene = *scene_, .margins = margins_, .candidates = *candidates_};
  const FrictionFactors factors_;
  ProxyState state_;
  ContactPlanes planes_;
  ProxyRest rest_;
  SubGoalChooser chooser_;
};

TEST_F(SubGoalTest, InFreeSpaceItIsTheTool) {
  const Vec3 h{0.0, -kDepth_m, 0.0};
  const SubGoal goal = choose(h);
  EXPECT_EQ(goal.point, h);
  EXPECT_EQ(goal.tool, h);
  EXPECT_FALSE(goal.settled);
}

TEST_F(SubGoalTest, AtTheToolTheProxyIsSettledWithoutFriction) {
  state_.friction = FrictionState::slip;
  EXPECT_TRUE(choose(state_.p_W).settled);
  EXPECT_EQ(state_.friction, FrictionState::free);
}

TEST_F(SubGoalTest, WithinTheStaticCircleTheProxyIsSettled) {
  hold_on(Vec3::UnitY());
  const SubGoal goal = choose({0.99 * kStatic * kDepth_m, -kDepth_m, 0.0});
  EXPECT_TRUE(goal.settled);
  EXPECT_EQ(goal.point, state_.p_W);
  EXPECT_EQ(state_.friction, FrictionState::stick);
}

TEST_F(SubGoalTest, BeyondItTheProxySlipsToTheRimForTheRestOfTheTick) {
  hold_on(Vec3::UnitY());
  const double aside_m = 1.01 * kStatic * kDepth_m;
  const SubGoal goal = choose({aside_m, -kDepth_m, 0.0});
  EXPECT_FALSE(goal.settled);
  EXPECT_FALSE(goal.lengthened);
  EXPECT_TRUE(goal.point.isApprox(Vec3{aside_m - kDynamic * kDepth_m, 0.0, 0.0}, 1e-12));
  EXPECT_TRUE(choose({0.0, -kDepth_m, 0.0}).settled);
  EXPECT_EQ(state_.friction, FrictionState::slip);
}

TEST_F(SubGoalTest, AMoveBelowANanometreIsNone) {
  hold_on(Vec3::UnitY());
  state_.friction = FrictionState::slip;
  EXPECT_TRUE(choose({kDynamic * kDepth_m + 0.5e-9, -kDepth_m, 0.0}).settled);
}

// Two planes of a crease along z: the second of two moves of a geometric series ends at its sum.
TEST_F(SubGoalTest, AlongACreaseTheSecondMoveIsLengthened) {
  ASSERT_TRUE(scene_->set_material(0, testing::kSlippery));
  hold_on(Vec3{1.0, 1.0, 0.0}.normalized());
  hold_on(Vec3{-1.0, 1.0, 0.0}.normalized());
  constexpr double kFirst_m = 0.0001;
  constexpr double kRatio = 0.5;
  const SubGoal first = choose({0.0, -kDepth_m, kFirst_m});
  EXPECT_FALSE(first.lengthened);
  EXPECT_NEAR(first.point.z(), kFirst_m, 1e-15);
  chooser_.leave(state_.p_W, first, rest_);
  const SubGoal second = choose({0.0, -kDepth_m, kRatio * kFirst_m});
  EXPECT_TRUE(second.lengthened);
  EXPECT_NEAR(second.point.z(), kRatio * kFirst_m / (1.0 - kRatio), 1e-12);
  chooser_.leave(state_.p_W, second, rest_);
  EXPECT_FALSE(choose({0.0, -kDepth_m, kRatio * kRatio * kFirst_m}).lengthened);
}

}  // namespace
}  // namespace tactus::rendering
