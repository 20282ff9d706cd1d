// The energy of bodies against closed forms.
#include "rendering/bodies/body_energy.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

TEST(BodyEnergy, ThePotentialEnergyIsTheWeightTimesTheHeight) {
  const RigidBody body(mass_of_ball(0.2, 0.01), {.translation = {3.0, 0.5, -1.0}}, Vec3::Zero(),
                       Vec3::Zero());
  EXPECT_NEAR(potential_energy_J(body, {0.0, -10.0, 0.0}), 0.2 * 10.0 * 0.5, 1e-15);
  EXPECT_NEAR(potential_energy_J(body, {2.0, 0.0, 0.0}), -0.2 * 2.0 * 3.0, 1e-15);
}

// Half a turn takes the point to the other side of the axis.
TEST(BodyEnergy, TheWorkIsTheForceAlongTheMotionOfItsPoint) {
  const RigidPose before{.translation = {1.0, 0.0, 0.0}};
  const RigidPose after{.rotation = body_turned(Vec3::UnitZ(), std::numbers::pi),
                        .translation = {1.0, 0.3, 0.0}};
  const Vec3 point(1.1, 0.0, 0.0);
  EXPECT_NEAR(work_on_body_J({2.0, 0.0, 0.0}, point, before, after), -2.0 * 0.2, 1e-15);
  EXPECT_NEAR(work_on_body_J({0.0, 2.0, 0.0}, point, before, after), 2.0 * 0.3, 1e-15);
}

// A step h begins with the velocity of its end, so that m g h v / 2 is lost at the speed v.
TEST(BodyEnergy, AFreeFallKeepsTheSumOfBothEnergies) {
  constexpr double kBall_kg = 0.2;
  BodyBench bench;
  bench.add_ball(0.01, kBall_kg, {0.0, 1.0, 0.0}, {});
  const Vec3 gravity(0.0, -kBodyGravity_m_per_s2, 0.0);
  const double start = potential_energy_J(bench.body(0), gravity);
  bench.run(0.3);
  const RigidBody& ball = bench.body(0);
  const double speed = ball.motion().velocity_W.norm();
  EXPECT_NEAR(ball.kinetic_energy_J(), 0.5 * kBall_kg * speed * speed, 1e-12);
  EXPECT_NEAR(ball.kinetic_energy_J() + potential_energy_J(ball, gravity), start,
              0.5 * kBall_kg * kBodyGravity_m_per_s2 * kBodyTick_s / 4.0 * speed + 1e-12);
}

}  // namespace
}  // namespace tactus::rendering
