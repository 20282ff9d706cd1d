// Cone, Coulomb and viscous, Stribeck, Karnopp: stops and stick-slip against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "host_tools/friction/sliding_mass.h"
#include "rendering/friction/cone.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using host::SlidingMass;
using host::SlidingMassState;
using rendering::apply_cone;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::update_friction;

FrictionParameters rigid(FrictionKind kind) {
  FrictionParameters parameters = published(kind);
  parameters.stiffness_N_per_m = 0.0;
  parameters.viscous_s_per_m = 0.0;
  return parameters;
}

// Lets the mass slide until it has come to rest.
SlidingMassState coast(const FrictionParameters& friction, double speed_m_per_s, double step_s) {
  SlidingMass mass({.friction = friction});
  mass.place(0.0, speed_m_per_s);
  while (mass.state().v_m_per_s > 0.0) {
    mass.step({}, step_s);
  }
  return mass.state();
}

TEST(Coulomb, StopsAMassAfterTheWayAndTheTimeOfTheClosedForm) {
  for (const double rate : kRates_Hz) {
    const SlidingMassState end = coast(rigid(FrictionKind::coulomb_viscous), 0.5, 1.0 / rate);
    EXPECT_NEAR(end.x_m, 0.125, 1e-6);
    EXPECT_NEAR(end.time_s, 0.5, 1.01 / rate);
  }
}

TEST(Coulomb, WithAViscousTermStopsAMassBySlowingItExponentially) {
  FrictionParameters friction = rigid(FrictionKind::coulomb_viscous);
  friction.viscous_s_per_m = 0.4;
  for (const double rate : kRates_Hz) {
    const SlidingMassState end = coast(friction, 0.5, 1.0 / rate);
    EXPECT_NEAR(end.x_m, 0.110490270, 1e-6);
    EXPECT_NEAR(end.time_s, 0.455803892, 1.01 / rate);
  }
}

TEST(Coulomb, WithASpringToStickByStopsWithinTheSpring) {
  FrictionParameters friction = rigid(FrictionKind::coulomb_viscous);
  friction.stiffness_N_per_m = 1e5;
  EXPECT_NEAR(coast(friction, 0.5, 1e-3).x_m, 0.125, 2e-5);
}

TEST(Karnopp, SticksAndSlipsByTheClosedForm) {
  for (const double rate : part_of(kRates_Hz)) {
    for (const double stiffness : {0.0, 1e6}) {
      FrictionParameters friction = rigid(FrictionKind::karnopp);
      friction.stiffness_N_per_m = stiffness;
      friction.damping_s_per_m = 1000.0;
      friction.viscous_s_per_m = 0.4;
      SlidingMass mass({.friction = friction, .spring_N_per_m = 2.0});
      std::vector<double> starts;
      std::vector<double> ends;
      std::vector<double> places;
      double fastest = 0.0;
      bool was_slipping = false;
      while (mass.state().time_s < 35.0) {
        const SlidingMassState& now =
            mass.step({.spring_end_m = 0.1 * (mass.state().time_s + 0.5 / rate)}, 1.0 / rate);
        const bool slips = now.v_m_per_s > 2e-3;
        if (slips != was_slipping) {
          (slips ? starts : ends).push_back(now.time_s);
          places.push_back(now.x_m);
        }
        was_slipping = slips;
        fastest = std::max(fastest, now.v_m_per_s);
      }
      ASSERT_GE(ends.size(), 4U);
      EXPECT_NEAR(fastest, 0.376819, 1e-3 * 0.376819);
      for (std::size_t i = 1; i < ends.size(); ++i) {
        EXPECT_NEAR(starts[i] - starts[i - 1], 6.453932708, 1e-3 * 6.453932708);
        // The time between speeds of 2 mm/s is a little shorter than from rest to rest.
        EXPECT_NEAR(ends[i] - starts[i], 2.813743718, 0.03);
        EXPECT_NEAR(places[2 * i + 1] - places[2 * i], 0.645393271, 1e-3);
      }
    }
  }
}

TEST(Karnopp, BreaksAwayAtTheStaticLevelWhateverTheRate) {
  for (const double rate : {0.1, 1.0, 50.0}) {
    SlidingMass mass({.friction = rigid(FrictionKind::karnopp)});
    double strongest = 0.0;
    while (!mass.state().friction.slipping) {
      strongest = mass.state().friction.force_N;
      mass.step({.push_N = rate * (mass.state().time_s + 0.5e-3)}, 1e-3);
    }
    EXPECT_NEAR(strongest, 1.5, 1.01e-3 * rate);
    EXPECT_EQ(mass.state().friction.force_N, 1.0);
  }
}

TEST(Stribeck, SlidesWithTheForceOfTheCurve) {
  const FrictionParameters parameters = rigid(FrictionKind::stribeck);
  FrictionMemory<double> state;
  for (const double v : {1e-4, 1e-3, -2e-3, 0.1}) {
    const double ratio = v / 1e-3;
    EXPECT_NEAR(update_friction(parameters, state, v * 1e-3, 2.0, 1e-3).force_N,
                2.0 * std::copysign(1.0 + 0.5 * std::exp(-ratio * ratio), v), 1e-14);
  }
}

// With the proxy's stiffness for sigma0, the elastic force is the stiffness times the proxy's lag.
TEST(Cone, IsTheConeOfTheProxyTickByTick) {
  constexpr double kStiffness_N_per_m = 500.0;
  constexpr std::uint64_t kSeed = 4;
  const FrictionParameters parameters{.kind = FrictionKind::cone,
                                      .coulomb = 0.5,
                                      .static_level = 0.8,
                                      .stiffness_N_per_m = kStiffness_N_per_m};
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> wish(0.0, 1e-3);
  FrictionMemory<Vec3> memory;
  rendering::FrictionState state = rendering::FrictionState::stick;
  Vec3 proxy = Vec3::Zero();
  Vec3 tool = Vec3::Zero();
  int slips = 0;
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 step{wish(random), wish(random), 0.0};
    const double depth = 0.005 + 0.004 * std::sin(0.01 * k);
    tool += step;
    const auto cone = apply_cone(proxy, tool, {0.8 * depth, 0.5 * depth}, state);
    proxy = cone.goal;
    state = cone.state;
    const auto result = update_friction(parameters, memory, step, kStiffness_N_per_m * depth, 1e-3);
    ASSERT_LE((result.force_N - kStiffness_N_per_m * (tool - proxy)).norm(), 1e-9) << k;
    ASSERT_EQ(result.slipping, state == rendering::FrictionState::slip) << k;
    slips += result.slipping ? 1 : 0;
  }
  EXPECT_GT(slips, 100);
  EXPECT_LT(slips, 9900);
}

// The trailing end of a rod of the length of the lag follows a tractrix: with the tool at s on the
// x axis, starting at right angles, it lags by r tanh(s / r) along the axis and r / cosh(s / r) off
// it.
TEST(Cone, ADraggedProxyDrawsATractrix) {
  const FrictionParameters parameters{
      .kind = FrictionKind::cone, .coulomb = 1.0, .static_level = 1.0, .stiffness_N_per_m = 1000.0};
  constexpr double kRadius_m = 1e-3;
  constexpr int kTicks = 20'000;
  constexpr double kWay_m = 4e-3;
  FrictionMemory<Vec3> memory;
  memory.elastic_force_N = {0.0, 1.0, 0.0};
  for (int k = 1; k <= kTicks; ++k) {
    const auto result =
        update_friction(parameters, memory, Vec3{kWay_m / kTicks, 0.0, 0.0}, 1.0, 1e-3);
    const double s = kWay_m * k / kTicks / kRadius_m;
    ASSERT_NEAR(result.bristle_m.x(), kRadius_m * std::tanh(s), 1e-3 * kRadius_m);
    ASSERT_NEAR(result.bristle_m.y(), kRadius_m / std::cosh(s), 1e-3 * kRadius_m);
  }
}

}  // namespace
}  // namespace tactus::testing
