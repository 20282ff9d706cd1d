// LuGre tick by tick: the exact recurrence, the steady curve, and what a normal force does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rendering/friction/friction_model.h"
#include "tests/support/csv.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using rendering::FrictionForce;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::steady_level;
using rendering::update_friction;

TEST(Lugre, FollowsTheExactRecurrenceSampleBySample) {
  const Csv csv("lugre_discretisation_A0.1_fs1000.csv");
  const FrictionParameters parameters = published(FrictionKind::lugre);
  FrictionMemory<double> state;
  double x = 0.0;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double displacement = csv.number(row, "x_m") - x;
    x = csv.number(row, "x_m");
    const auto result = update_friction(parameters, state, displacement, 1.0, kTick_s);
    // Twelve digits of x leave this much of its differences.
    ASSERT_NEAR(result.bristle_m, csv.number(row, "z_exact_zoh_v_m"), 2e-13) << "row " << row;
    ASSERT_NEAR(result.force_N, csv.number(row, "F_exact_zoh_v_N"), 2e-7) << "row " << row;
  }
}

TEST(Lugre, SlidesSteadilyOnTheStribeckCurve) {
  const Csv csv("lugre_stribeck_steady.csv");
  const FrictionParameters parameters = published(FrictionKind::lugre);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double v = csv.number(row, "v_m_s");
    EXPECT_NEAR(steady_level(parameters, std::fabs(v)), csv.number(row, "g_N"), 1e-11);
    if (v == 0.0) {
      continue;
    }
    FrictionMemory<double> state;
    FrictionForce<double> result;
    // A step is as long as it takes to slide by forty bristle lengths.
    result = update_friction(parameters, state, std::copysign(1e-3, v), 1.0, 1e-3 / std::fabs(v));
    result = update_friction(parameters, state, std::copysign(1e-3, v), 1.0, 1e-3 / std::fabs(v));
    EXPECT_NEAR(result.force_N, csv.number(row, "F_ss_N"), 1e-11) << v;
    EXPECT_NEAR(result.mean_force_N, csv.number(row, "F_ss_N"), 1e-11) << v;
    EXPECT_NEAR(result.bristle_m, csv.number(row, "z_ss_m"), 1e-16) << v;
    EXPECT_TRUE(result.slipping);
  }
}

TEST(Lugre, TheExponentOfTheStribeckCurveIsFree) {
  FrictionParameters parameters = published(FrictionKind::lugre);
  for (const double alpha : {0.5, 1.0, 1.7, 2.0, 3.0}) {
    parameters.stribeck_exponent = alpha;
    for (const double v : {1e-9, 1e-4, 3e-4, 1e-3, 2e-3, 1e-2, 1.0, 1e4}) {
      EXPECT_NEAR(steady_level(parameters, v), 1.0 + 0.5 * std::exp(-std::pow(v / 1e-3, alpha)),
                  1e-14)
          << alpha << " " << v;
    }
    EXPECT_EQ(steady_level(parameters, 0.0), 1.5);
  }
}

TEST(Lugre, DampingFadesWithTheVelocityWhereItIsToldTo) {
  FrictionParameters parameters = published(FrictionKind::lugre);
  EXPECT_EQ(damping_at(parameters, 1.0), parameters.damping_s_per_m);
  parameters.damping_fade_m_per_s = 0.02;
  for (const double v : {0.0, 1e-3, 0.02, 0.05}) {
    EXPECT_NEAR(damping_at(parameters, v), 316.22776601683796 * std::exp(-(v / 0.02) * (v / 0.02)),
                1e-11);
  }
  EXPECT_EQ(damping_at(parameters, 1.0), 0.0);
}

TEST(Lugre, LevelsAndDampingScaleWithTheNormalForceAndTheBristleDoesNot) {
  FrictionParameters parameters = published(FrictionKind::lugre);
  FrictionParameters threefold = parameters;
  threefold.coulomb *= 3.0;
  threefold.static_level *= 3.0;
  threefold.viscous_s_per_m *= 3.0;
  threefold.damping_s_per_m *= 3.0;
  FrictionMemory<double> pressed;
  FrictionMemory<double> plain;
  for (int k = 0; k < 1000; ++k) {
    const double displacement = 1e-5 * std::sin(0.01 * k * k);
    const auto a = update_friction(parameters, pressed, displacement, 3.0, 1e-3);
    const auto b = update_friction(threefold, plain, displacement, 1.0, 1e-3);
    ASSERT_NEAR(a.force_N, b.force_N, 1e-12 * std::fabs(b.force_N) + 1e-13);
  }
}

TEST(Lugre, PressingHarderAddsNoForceByItself) {
  const FrictionParameters parameters = published(FrictionKind::lugre);
  FrictionMemory<double> state;
  update_friction(parameters, state, 1e-3, 1.0, 1.0);
  const double force = update_friction(parameters, state, 0.0, 1.0, 1e-3).force_N;
  EXPECT_GT(force, 1.0);
  EXPECT_EQ(update_friction(parameters, state, 0.0, 5.0, 1e-3).force_N, force);
}

TEST(Lugre, FollowsALoadThatFallsDownToNothing) {
  const FrictionParameters parameters = published(FrictionKind::lugre);
  FrictionMemory<double> state;
  update_friction(parameters, state, 1e-3, 1.0, 1.0);
  double last = update_friction(parameters, state, 0.0, 1.0, 1e-3).force_N;
  for (int k = 99; k >= 0; --k) {
    const double normal = 0.01 * k;
    const double force = update_friction(parameters, state, 0.0, normal, 1e-3).force_N;
    EXPECT_LE(force, parameters.static_level * normal);
    EXPECT_LE(std::fabs(force - last), 0.0151);
    last = force;
  }
  EXPECT_EQ(last, 0.0);
}

TEST(Lugre, ContactMadeAgainStartsWithoutForce) {
  const FrictionParameters parameters = published(FrictionKind::lugre);
  FrictionMemory<double> state;
  update_friction(parameters, state, 1e-3, 1.0, 1.0);
  for (const double none : {0.0, -1.0, std::nan("")}) {
    FrictionMemory<double> lifted = state;
    EXPECT_EQ(update_friction(parameters, lifted, 1e-3, none, 1e-3).force_N, 0.0);
    EXPECT_EQ(update_friction(parameters, lifted, 0.0, 1.0, 1e-3).force_N, 0.0);
  }
}

}  // namespace
}  // namespace tactus::testing
