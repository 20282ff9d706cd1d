// Several surfaces with friction models of their own in one contact. The oracle is one surface.
#include "rendering/friction/joint_friction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "rendering/friction/friction_model.h"

namespace tactus::rendering {
namespace {

constexpr double kSpring_N_per_m = 1000.0;
constexpr double kNormal_N = 2.0;
constexpr double kTick_s = 1e-3;

class JointFrictionTest : public ::testing::Test {
 protected:
  // Lets the tool go on by one step over the surfaces, which share the normal force equally.
  // Returns the lag along the step, m.
  double step(const std::vector<std::uint32_t>& surfaces) { return step(joint_, surfaces); }
  double step(JointFriction& joint, const std::vector<std::uint32_t>& numbers) const {
    joint.begin_tick({kStep_m, 0.0, 0.0}, kTick_s);
    std::vector<JointSurface> surfaces;
    surfaces.reserve(numbers.size());
    for (const std::uint32_t number : numbers) {
      surfaces.push_back({.number = number,
                          .sliding = {.friction = dahl_, .stiffness_N_per_m = kSpring_N_per_m},
                          .normal_force_N = kNormal_N / static_cast<double>(numbers.size())});
    }
    return joint.lag(surfaces, Vec3::UnitY()).lag_m.x();
  }

  static constexpr double kStep_m = 20e-6;
  FrictionParameters dahl_{.kind = FrictionKind::dahl, .coulomb = 0.5, .stiffness_N_per_m = 600.0};
  JointFriction joint_;
};

TEST_F(JointFrictionTest, OfSurfacesOfOneMaterialIsThatOfOne) {
  JointFriction one;
  JointFriction several;
  for (int tick = 0; tick < 100; ++tick) {
    EXPECT_NEAR(step(several, {1, 2, 3}), step(one, {7}), 1e-12) << tick;
  }
}

// A tool that stands still while its contact turns to another plane does no work, so that the
// springs of the depth and of the bristle together store no more than before.
TEST_F(JointFrictionTest, ATurnOfThePlaneAddsNoEnergy) {
  constexpr double kDepth_m = 2e-3;
  const auto twice_energy_J = [&](double depth_m, const Vec3& lag_m) {
    const double force_N = kSpring_N_per_m * lag_m.norm();
    return kSpring_N_per_m * depth_m * depth_m + force_N * force_N / dahl_.stiffness_N_per_m;
  };
  for (const double deeper_m : {-1e-4, 0.0, 1e-5, 2e-5, 1e-3}) {
    JointFriction joint;
    std::array<JointSurface, 1> surfaces{
        {{.number = 1,
          .sliding = {.friction = dahl_, .stiffness_N_per_m = kSpring_N_per_m, .depth_m = kDepth_m},
          .normal_force_N = kNormal_N}}};
    Vec3 before_m = Vec3::Zero();
    for (int tick = 0; tick < 30; ++tick) {
      joint.begin_tick({kStep_m, 0.0, 0.0}, kTick_s);
      before_m = joint.lag(surfaces, Vec3::UnitY()).lag_m;
    }
    surfaces[0].sliding.depth_m += deeper_m;
    joint.begin_tick(Vec3::Zero(), kTick_s);
    const Vec3 after_m = joint.lag(surfaces, Vec3::UnitX()).lag_m;
    const double before_J = twice_energy_J(kDepth_m, before_m);
    EXPECT_GT(before_m.norm(), 0.0);
    if (deeper_m <= 0.0) {
      EXPECT_NEAR(after_m.norm(), before_m.norm(), 1e-15) << deeper_m;
    } else if (after_m != Vec3::Zero()) {
      EXPECT_NEAR(twice_energy_J(kDepth_m + deeper_m, after_m), before_J, 1e-15) << deeper_m;
    }
  }
}

TEST_F(JointFrictionTest, GoesOnFromOneSurfaceToTheNext) {
  double lag_m = 0.0;
  for (std::uint32_t tick = 0; tick < 60; ++tick) {
    // The first tick of contact is without force.
    const double level_m = 0.5 * kNormal_N / kSpring_N_per_m;
    const double bent = tick * kStep_m * dahl_.stiffness_N_per_m / (0.5 * kNormal_N);
    lag_m = step({tick / 20});
    EXPECT_NEAR(lag_m, level_m * (1.0 - std::exp(-bent)), 1e-12) << tick;
  }
  EXPECT_GT(lag_m, 0.0);
}

TEST_F(JointFrictionTest, IsTheSameWhenASurfaceJoinsOrLetsGo) {
  JointFriction one;
  for (std::uint32_t tick = 0; tick < 60; ++tick) {
    const std::vector<std::uint32_t> numbers =
        tick < 20 ? std::vector<std::uint32_t>{1} : std::vector<std::uint32_t>{1, 2 + tick / 40};
    EXPECT_NEAR(step(numbers), step(one, {1}), 1e-12) << tick;
  }
}

TEST_F(JointFrictionTest, ATickWithoutContactEndsTheMemory) {
  for (int tick = 0; tick < 60; ++tick) {
    step({1, 2});
  }
  joint_.begin_tick({kStep_m, 0.0, 0.0}, kTick_s);
  EXPECT_EQ(step({1, 2}), 0.0);
}

}  // namespace
}  // namespace tactus::rendering
