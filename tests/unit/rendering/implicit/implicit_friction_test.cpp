// Friction on the plane y = 0 of a formula, against the friction circle and Dahl's closed form.
#include "rendering/contact/implicit_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

// A proxy at the origin of a surface of which a unit is 50 mm, and a tool 2 mm below it.
class ImplicitFrictionTest : public ::testing::Test {
 protected:
  static constexpr double kScale_m = 0.05;
  static constexpr double kStatic = 0.6;
  static constexpr double kDynamic = 0.4;
  static constexpr double kDepth_m = 0.002;

  // Returns the goal for a tool so far aside.
  ImplicitGoal hold(ImplicitFriction& friction, double aside_m) {
    const Vec3 h{aside_m / kScale_m, -kDepth_m / kScale_m, 0.0};
    planes_.clear();
    planes_.add({.normal = Vec3::UnitY(), .offset = 0.0});
    return friction.hold(planes_.push(h, plane_.surface), planes_, h, plane_.surface, state_);
  }

  const FormulaSurface plane_{"y", kScale_m};
  ImplicitPlanes planes_;
  const Material rough_ = rough(kStatic, kDynamic);
  ImplicitProxyState state_;
};

TEST_F(ImplicitFrictionTest, TheProxySticksWithinTheStaticCircle) {
  ImplicitFriction friction(rough_);
  EXPECT_TRUE(hold(friction, 0.99 * kStatic * kDepth_m).settled);
  EXPECT_EQ(state_.friction, FrictionState::stick);
}

TEST_F(ImplicitFrictionTest, BeyondItTheProxySlipsToTheRimForTheRestOfTheTick) {
  ImplicitFriction friction(rough_);
  const double aside_m = 1.01 * kStatic * kDepth_m;
  const ImplicitGoal goal = hold(friction, aside_m);
  EXPECT_FALSE(goal.settled);
  EXPECT_NEAR(goal.point.x() * kScale_m, aside_m - kDynamic * kDepth_m, 1e-15);
  EXPECT_TRUE(hold(friction, 0.0).settled);
  EXPECT_EQ(state_.friction, FrictionState::slip);
  EXPECT_EQ(friction.lag_O(), Vec3::Zero());
}

TEST_F(ImplicitFrictionTest, AMoveBelowANanometreIsNone) {
  ImplicitFriction friction(kNoFriction);
  EXPECT_TRUE(hold(friction, 0.9e-9).settled);
  EXPECT_FALSE(hold(friction, 1.1e-9).settled);
}

TEST_F(ImplicitFrictionTest, AModelMakesTheGoalLagByItsForceOverTheStiffness) {
  Material dahl = rough_;
  dahl.friction = {.kind = FrictionKind::dahl, .coulomb = kDynamic, .stiffness_N_per_m = 5000.0};
  ImplicitFriction friction(dahl);
  constexpr double kStep_m = 0.0001;
  const double level_N = kDynamic * dahl.stiffness_N_per_m * kDepth_m;
  for (int tick = 0; tick < 20; ++tick) {
    const Vec3 step = tick == 0 ? Vec3::Zero() : Vec3{kStep_m, 0.0, 0.0};  // contact begins
    state_.model.begin_tick(step, 0.001);
    const double x = kStep_m * tick;
    const double force_N =
        level_N * (1.0 - std::exp(-dahl.friction.stiffness_N_per_m * x / level_N));
    const double lag_m = force_N / dahl.stiffness_N_per_m;
    EXPECT_NEAR(hold(friction, x).point.x() * kScale_m, x - lag_m, 1e-12) << tick;
    EXPECT_NEAR(friction.lag_O().x() * kScale_m, lag_m, 1e-12) << tick;
  }
}

}  // namespace
}  // namespace tactus::rendering
