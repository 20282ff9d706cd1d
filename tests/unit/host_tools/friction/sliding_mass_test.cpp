// The mass and its solver; the friction itself is tested in tests/unit/rendering/friction.
#include "host_tools/friction/sliding_mass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionParameters;

constexpr double kStep_s = 1e-3;

TEST(SlidingMass, WithoutFrictionSwingsOnItsSpring) {
  SlidingMass mass({.mass_kg = 0.5, .spring_N_per_m = 50.0});
  mass.place(0.01, 0.0);
  for (int k = 0; k < 10'000; ++k) {
    const SlidingMassState& state = mass.step({}, kStep_s);
    // The midpoint rule is late by (omega T)^2 / 24 of the phase.
    ASSERT_NEAR(state.x_m, 0.01 * std::cos(10.0 * state.time_s), 1e-5);
    ASSERT_NEAR(mass.energy_J() + 25.0 * state.x_m * state.x_m, 25.0 * 1e-4, 1e-12);
  }
}

TEST(SlidingMass, AccountsForEveryJoule) {
  constexpr std::uint64_t kSeed = 8;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> push(0.0, 5.0);
  for (const FrictionKind kind : {FrictionKind::cone, FrictionKind::karnopp, FrictionKind::dahl,
                                  FrictionKind::lugre, FrictionKind::elasto_plastic}) {
    const FrictionParameters friction{.kind = kind,
                                      .coulomb = 1.0,
                                      .static_level = 1.5,
                                      .viscous_s_per_m = 0.4,
                                      .stiffness_N_per_m = 1e5,
                                      .damping_s_per_m = 300.0};
    SlidingMass mass({.friction = friction});
    double balance_J = 0.0;
    double push_N = 0.0;
    for (int k = 0; k < 5000; ++k) {
      push_N = k % 50 == 0 ? push(random) : push_N;
      const SlidingMassState before = mass.state();
      const SlidingMassState& after = mass.step({.push_N = push_N}, kStep_s);
      const double kinetic_J =
          0.5 * (after.v_m_per_s * after.v_m_per_s - before.v_m_per_s * before.v_m_per_s);
      balance_J += kinetic_J - (push_N - after.friction.mean_force_N) * (after.x_m - before.x_m);
    }
    EXPECT_NEAR(balance_J, 0.0, 1e-10) << static_cast<int>(kind);
  }
}

TEST(SlidingMass, OnARigidSurfaceStaysUntilItIsPushedHarderThanTheSurfaceHolds) {
  SlidingMass mass(
      {.friction = {.kind = FrictionKind::karnopp, .coulomb = 0.5, .static_level = 0.8},
       .normal_force_N = 2.0});
  for (int k = 0; k < 100; ++k) {
    mass.step({.push_N = 1.599}, kStep_s);
  }
  EXPECT_EQ(mass.state().x_m, 0.0);
  EXPECT_EQ(mass.state().friction.force_N, 1.599);
  mass.step({.push_N = 1.601}, kStep_s);
  EXPECT_GT(mass.state().x_m, 0.0);
  EXPECT_NEAR(mass.state().friction.force_N, 1.0, 1e-12);
}

}  // namespace
}  // namespace tactus::host
