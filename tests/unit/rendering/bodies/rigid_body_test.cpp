// The motion of one body without forces and under gravity, against closed forms.
#include "rendering/bodies/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::share_of;

constexpr double kFlightTick_s = 1e-3;

RigidBody spinning(const Vec3& moments_kg_m2, const Vec3& angular_velocity_O) {
  return {{.mass_kg = 2.0, .inertia_C = moments_kg_m2.asDiagonal()},
          {},
          Vec3(0.3, -0.1, 0.2),
          angular_velocity_O};
}

// Returns the times at which a component of the angular velocity in the body's frame changes sign,
// s, found between the ticks by a straight line.
std::vector<double> zeros_of_second_component(RigidBody body, double until_s) {
  std::vector<double> zeros;
  const auto second = [](const RigidBody& b) {
    return (b.motion().rotation_WO.transpose() * b.angular_velocity_W()).y();
  };
  double before = second(body);
  for (int i = 0; i * kFlightTick_s < until_s; ++i) {
    body.move(kFlightTick_s);
    const double now = second(body);
    if ((before > 0.0) != (now > 0.0)) {
      zeros.push_back((i + before / (before - now)) * kFlightTick_s);
    }
    before = now;
  }
  return zeros;
}

TEST(RigidBody, KeepsMomentumEnergyAndItsShapeInFreeFlight) {
  const int ticks = share_of(1'000'000);
  for (const Vec3& spin : {Vec3(0.01, 10.0, 0.0), Vec3(3.0, -7.0, 20.0), Vec3(0.0, 0.0, 80.0)}) {
    RigidBody body = spinning(Vec3(1.0, 2.0, 3.0), spin);
    const BodyMotion start = body.motion();
    const double energy_J = body.kinetic_energy_J();
    double worst_J = 0.0;
    double worst_shape = 0.0;
    for (int i = 0; i < ticks; ++i) {
      body.move(kFlightTick_s);
      const Mat3& R = body.motion().rotation_WO;
      worst_J = std::max(worst_J, std::abs(body.kinetic_energy_J() - energy_J));
      worst_shape = std::max(worst_shape, (R.transpose() * R - Mat3::Identity()).norm());
    }
    EXPECT_EQ(body.motion().velocity_W, start.velocity_W);
    EXPECT_EQ(body.motion().angular_momentum_W, start.angular_momentum_W);
    EXPECT_LT(worst_J, 1e-9 * energy_J);
    EXPECT_LT(worst_shape, 1e-14);
    const Vec3 path = ticks * kFlightTick_s * start.velocity_W;
    EXPECT_LT((body.motion().center_W - path).norm(), 1e-9 * path.norm());
  }
}

// The period is 4 K(k) / (w sqrt((I3 - I2)(I2 - I1) / (I1 I3))) with the elliptic integral K
// (Landau and Lifshitz, "Mechanics", 37).
TEST(RigidBody, TumblesAboutItsIntermediateAxisInTheTimeOfTheEllipticIntegral) {
  const auto zeros =
      zeros_of_second_component(spinning(Vec3(1.0, 2.0, 3.0), Vec3(0.01, 10.0, 0.0)), 8.0);
  ASSERT_EQ(zeros.size(), 3U);
  EXPECT_NEAR(zeros[0], 1.436571, 1e-3 * 1.436571);
  EXPECT_NEAR(zeros[1], 4.309714, 1e-3 * 4.309714);
  EXPECT_NEAR(zeros[2], 7.182856, 1e-3 * 7.182856);
  EXPECT_NEAR(zeros[2] - zeros[0], 5.746284887, 1e-3 * 5.746284887);
}

// A symmetric top without torque precesses about its momentum at L / I1 (Goldstein, 5.6).
TEST(RigidBody, PrecessesAsASymmetricTop) {
  RigidBody body = spinning(Vec3(2.0, 2.0, 3.0), Vec3(1.0, 0.0, 20.0));
  const Vec3 momentum = body.motion().angular_momentum_W;
  const double rate = momentum.norm() / 2.0;
  const Vec3 axis_0 = body.motion().rotation_WO.col(2);
  const int ticks = 1000;
  for (int i = 0; i < ticks; ++i) {
    body.move(kFlightTick_s);
  }
  const Vec3 expected =
      Eigen::AngleAxisd(rate * ticks * kFlightTick_s, momentum.normalized()) * axis_0;
  EXPECT_LT((body.motion().rotation_WO.col(2) - expected).norm(), 2e-4);
}

TEST(RigidBody, TurnsAboutAPrincipalAxisExactly) {
  RigidBody body = spinning(Vec3(1.0, 2.0, 3.0), Vec3(0.0, 0.0, 100.0));
  for (int i = 0; i < 1000; ++i) {
    body.move(kFlightTick_s);
  }
  const Mat3 expected = Eigen::AngleAxisd(100.0, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_LT((body.motion().rotation_WO - expected).norm(), 1e-11);
}

TEST(RigidBody, FallsAndSlowsDownAsItsDampingSays) {
  const Vec3 gravity(0.0, -9.80665, 0.0);
  RigidBody body({.mass_kg = 0.5, .linear_damping_per_s = 4.0, .angular_damping_per_s = 2.0}, {},
                 Vec3::Zero(), Vec3(5.0, 0.0, 0.0));
  constexpr double kStep_s = 1e-4;
  for (int i = 0; i < 10'000; ++i) {
    body.accelerate(gravity, kStep_s);
    body.move(kStep_s);
  }
  EXPECT_NEAR(body.motion().velocity_W.y(), -9.80665 / 4.0 * (1.0 - std::exp(-4.0)), 2e-3);
  EXPECT_NEAR(body.angular_velocity_W().x(), 5.0 * std::exp(-2.0), 1e-3);
}

TEST(RigidBody, GainsTheWorkOfAnImpulse) {
  const BodyMass mass{
      .mass_kg = 0.3,
      .center_O = Vec3(0.01, -0.02, 0.005),
      .inertia_C = (Mat3() << 2e-4, 3e-5, -1e-5, 3e-5, 3e-4, 2e-5, -1e-5, 2e-5, 2.5e-4).finished()};
  ASSERT_TRUE(valid(mass));
  const RigidPose pose{
      .rotation = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix(),
      .translation = Vec3(0.1, 0.2, 0.3)};
  RigidBody body(mass, pose, Vec3(0.1, 0.0, -0.2), Vec3(1.0, 2.0, 3.0));
  EXPECT_LT((body.pose().translation - pose.translation).norm(), 1e-15);
  const Vec3 point(0.15, 0.18, 0.33);
  const Vec3 before = body.velocity_at(point);
  const Vec3 impulse(0.01, -0.03, 0.02);
  const double energy_J = body.kinetic_energy_J();
  body.push(impulse, (point - body.motion().center_W).cross(impulse));
  const Vec3 after = body.velocity_at(point);
  EXPECT_NEAR(body.kinetic_energy_J() - energy_J, impulse.dot(0.5 * (before + after)), 1e-14);
  EXPECT_LT((body.twist().at(point - body.pose().translation) - after).norm(), 1e-14);
}

TEST(RigidBody, RefusesMassesThatNoBodyHas) {
  const auto with = [](const Vec3& moments) {
    return BodyMass{.mass_kg = 1.0, .inertia_C = moments.asDiagonal()};
  };
  EXPECT_TRUE(valid(with(Vec3(1.0, 2.0, 3.0)))) << "a flat body";
  EXPECT_FALSE(valid(with(Vec3(1.0, 2.0, 3.1))));
  EXPECT_FALSE(valid(with(Vec3(1.0, -1.0, 1.0))));
  EXPECT_FALSE(valid({.mass_kg = 0.0}));
  EXPECT_FALSE(valid({.mass_kg = 1.0, .linear_damping_per_s = -1.0}));
  BodyMass skew;
  skew.inertia_C(0, 1) = 0.01;
  EXPECT_FALSE(valid(skew));
}

}  // namespace
}  // namespace tactus::rendering
