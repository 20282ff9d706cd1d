// Projection and friction on a floor and in a corner, against closed forms.
#include "rendering/contact/friction_hold.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/materials.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/contact/steps/add_plane.h"

namespace tactus::rendering {
namespace {

// A proxy at rest at the origin on the plane y = 0 of object 0, which is rough.
class FrictionHoldTest : public ::testing::Test {
 protected:
  static constexpr double kStatic = 0.6;
  static constexpr double kDynamic = 0.4;
  static constexpr double kDepth_m = 0.002;

  FrictionHoldTest() {
    EXPECT_TRUE(scene_->set({&box_.object(), 1}));
    hold_on(Vec3::UnitY());
  }

  void hold_on(const Vec3& normal) {
    testing::add_plane(planes_, {.plane = {.normal = normal, .offset = 0.0}}, rest_.flags);
  }
  ActiveConstraints project(const Vec3& h) {
    return find_active_constraints(*scene_, factors_, state_, h, planes_, rest_);
  }
  HeldGoal hold(const Vec3& h) {
    const ActiveConstraints active = project(h);
    return hold_by_friction(*scene_, active, rest_, h, planes_, state_, slipped_);
  }

  testing::Solid box_{testing::box({0.01, 0.01, 0.01}), Sides::one, testing::kRough};
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  ContactPlanes planes_;
  FrictionFactors factors_;
  ProxyRest rest_;
  ProxyState state_;
  bool slipped_ = false;
};

TEST_F(FrictionHoldTest, OnePlaneGivesACircleOfItsCoefficientTimesTheDepth) {
  const ActiveConstraints active = project({0.0, -kDepth_m, 0.0});
  EXPECT_NEAR(active.circle.static_radius_m, kStatic * kDepth_m, 1e-15);
  EXPECT_NEAR(active.circle.dynamic_radius_m, kDynamic * kDepth_m, 1e-15);
  EXPECT_TRUE(active.are_cones);
  EXPECT_EQ(rest_.normal_W, Vec3::UnitY());
  ASSERT_EQ(rest_.plane_count, 1U);
  EXPECT_NEAR(rest_.pressure_m[0], kDepth_m, 1e-15);
}

TEST_F(FrictionHoldTest, TwoPlanesAddTheirCirclesAndBlendTheirNormals) {
  hold_on(Vec3::UnitX());
  const ActiveConstraints active = project({-0.001, -kDepth_m, 0.0});
  EXPECT_NEAR(active.circle.static_radius_m, kStatic * (0.001 + kDepth_m), 1e-15);
  EXPECT_TRUE(rest_.normal_W.isApprox(Vec3{0.001, kDepth_m, 0.0}.normalized(), 1e-12));
}

TEST_F(FrictionHoldTest, AFactorScalesTheCircleAndADepthReplacesTheGoals) {
  factors_ = {.object = {0}, .factor = {0.5}, .count = 1, .depth_m = 2 * kDepth_m};
  const ActiveConstraints active = project({0.0, -kDepth_m, 0.0});
  EXPECT_NEAR(active.circle.static_radius_m, 0.5 * kStatic * 2 * kDepth_m, 1e-15);
  EXPECT_NEAR(active.push_m[0], 0.5 * 2 * kDepth_m, 1e-15);
}

TEST_F(FrictionHoldTest, TheProxySticksWithinTheStaticCircle) {
  const HeldGoal held = hold({0.99 * kStatic * kDepth_m, -kDepth_m, 0.0});
  EXPECT_TRUE(held.settled);
  EXPECT_TRUE(held.sticks);
  EXPECT_EQ(held.point, Vec3::Zero());
  EXPECT_EQ(state_.friction, FrictionState::stick);
}

TEST_F(FrictionHoldTest, TheProxySlipsToTheRimOfTheDynamicCircle) {
  const double aside_m = 1.01 * kStatic * kDepth_m;
  const HeldGoal held = hold({aside_m, -kDepth_m, 0.0});
  EXPECT_FALSE(held.settled);
  EXPECT_FALSE(held.sticks);
  EXPECT_TRUE(held.point.isApprox(Vec3{aside_m - kDynamic * kDepth_m, 0.0, 0.0}, 1e-12));
  EXPECT_EQ(state_.friction, FrictionState::slip);
  EXPECT_TRUE(slipped_);
}

TEST_F(FrictionHoldTest, AProxyThatSlippedSlipsForTheRestOfTheTick) {
  slipped_ = true;
  hold({0.1 * kDynamic * kDepth_m, -kDepth_m, 0.0});
  EXPECT_EQ(state_.friction, FrictionState::slip);
}

TEST_F(FrictionHoldTest, AModelMakesTheProxyLagByItsForceOverTheStiffness) {
  Material dahl = testing::kRough;
  dahl.friction = {.kind = FrictionKind::dahl, .coulomb = kDynamic, .stiffness_N_per_m = 5000.0};
  ASSERT_TRUE(scene_->set_material(0, dahl));
  scene_->begin_tick(0.001, 0.001);
  constexpr double kStep_m = 0.0001;
  double expected_N = 0.0;  // Dahl's closed form, as the tool goes on at the same depth
  const double level_N = kDynamic * dahl.stiffness_N_per_m * kDepth_m;
  for (int tick = 0; tick < 20; ++tick) {
    const Vec3 step = tick == 0 ? Vec3::Zero() : Vec3{kStep_m, 0.0, 0.0};  // contact begins
    state_.models.begin_tick(step, 0.001);
    const double x = kStep_m * tick;
    expected_N =
        level_N * (1.0 - std::exp(-dahl.friction.stiffness_N_per_m * kStep_m * tick / level_N));
    const HeldGoal held = hold({x, -kDepth_m, 0.0});
    const double lag_m = expected_N / dahl.stiffness_N_per_m;
    EXPECT_NEAR(held.point.x(), x - lag_m, 1e-12) << tick;
    EXPECT_NEAR(held.tool.x(), x - lag_m, 1e-12) << tick;
  }
  EXPECT_GT(expected_N, 0.9 * level_N);
}

TEST_F(FrictionHoldTest, TheLastContactGivesTheForceOfATickThatEndsEarly) {
  const LastContact last{.object = 0, .triangle = 0, .normal_W = Vec3::UnitY()};
  ProxyRest rest;
  keep_last_contact(*scene_, last, Vec3::Zero(), {0.0, -kDepth_m, 0.0}, rest);
  ASSERT_EQ(rest.plane_count, 1U);
  EXPECT_NEAR(rest.pressure_m[0], kDepth_m, 1e-15);
  EXPECT_EQ(rest.normal_W, Vec3::UnitY());
  ProxyRest none;
  keep_last_contact(*scene_, {}, Vec3::Zero(), {0.0, -kDepth_m, 0.0}, none);
  EXPECT_EQ(none.plane_count, 0U);
}

}  // namespace
}  // namespace tactus::rendering
