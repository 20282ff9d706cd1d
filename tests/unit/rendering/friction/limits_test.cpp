// Each model turns into a simpler one at its limits, and none is ever unstable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "host_tools/friction/sliding_mass.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/friction/every_kind.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using host::SlidingMass;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::update_friction;

FrictionParameters plain(FrictionKind kind, double static_level) {
  return {.kind = kind,
          .coulomb = 0.5,
          .static_level = static_level,
          .stribeck_velocity_m_per_s = 1e-3,
          .stiffness_N_per_m = 1000.0};
}

// A stroke out and back, 1 mm each tick, a bristle length of 0.5 mm.
std::vector<double> strokes(const FrictionParameters& parameters, double path_m) {
  std::vector<double> forces;
  FrictionMemory<double> memory;
  for (int k = 0; k < 400; ++k) {
    const double motion = (k / 100) % 2 == 0 ? path_m : -path_m;
    forces.push_back(update_friction(parameters, memory, motion, 2.0, kTick_s).force_N);
  }
  return forces;
}

void expect_alike(const FrictionParameters& a, const FrictionParameters& b, double path_m,
                  double tolerance_N) {
  const auto first = strokes(a, path_m);
  const auto second = strokes(b, path_m);
  for (std::size_t k = 0; k < first.size(); ++k) {
    ASSERT_NEAR(first[k], second[k], tolerance_N) << k;
  }
}

TEST(Limits, WithoutABreakAwayForceTheSlidersAreOneAndLugreIsDahl) {
  const FrictionParameters coulomb = plain(FrictionKind::coulomb_viscous, 0.5);
  for (const auto kind : {FrictionKind::cone, FrictionKind::karnopp, FrictionKind::stribeck}) {
    expect_alike(plain(kind, 0.5), coulomb, 1e-4, 1e-9);
  }
  expect_alike(plain(FrictionKind::lugre, 0.5), plain(FrictionKind::dahl, 0.5), 1e-4, 0.0);
}

TEST(Limits, AnElasticFractionNearOneMakesTheElastoPlasticBristleCoulombsSpring) {
  FrictionParameters bristle = plain(FrictionKind::elasto_plastic, 0.5);
  bristle.elastic_fraction = 1.0 - 1e-6;
  expect_alike(bristle, plain(FrictionKind::coulomb_viscous, 0.5), 1e-4, 1e-4);
}

TEST(Limits, AStiffBristleIsRigidCoulombFriction) {
  FrictionParameters rigid = plain(FrictionKind::coulomb_viscous, 0.5);
  rigid.stiffness_N_per_m = 0.0;
  for (const auto kind : {FrictionKind::cone, FrictionKind::coulomb_viscous, FrictionKind::stribeck,
                          FrictionKind::karnopp, FrictionKind::dahl, FrictionKind::lugre,
                          FrictionKind::elasto_plastic}) {
    for (const double stiffness : {1e9, 1e15, 1e300}) {
      FrictionParameters stiff = plain(kind, 0.5);
      stiff.stiffness_N_per_m = stiffness;
      expect_alike(stiff, rigid, 1e-4, 1e-9);
    }
  }
}

TEST(Limits, WithoutALevelThereIsNoFriction) {
  for (NamedFriction friction : every_kind(1000.0)) {
    friction.parameters.coulomb = 0.0;
    friction.parameters.static_level = 0.0;
    friction.parameters.viscous_s_per_m = 0.0;
    ASSERT_TRUE(valid(friction.parameters)) << friction.name;
    for (const double force : strokes(friction.parameters, 1e-4)) {
      ASSERT_EQ(force, 0.0) << friction.name;
    }
  }
}

TEST(Limits, NoSpeedMakesAStiffBristleUnstableAtOneKilohertz) {
  constexpr std::uint64_t kSeed = 17;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> decade(-9.0, 1.0);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const NamedFriction& friction : every_kind(1e5)) {
    const FrictionParameters& p = friction.parameters;
    FrictionMemory<Vec3> memory;
    for (int k = 0; k < std::max(10'000, part_of(100'000)); ++k) {
      const double speed = std::pow(10.0, decade(random));
      const double normal = 5.0 * std::fabs(any(random));
      const Vec3 motion = kTick_s * speed * Vec3{any(random), any(random), 0.0};
      const auto result = update_friction(p, memory, motion, normal, kTick_s);
      // The bound includes what sigma1 and sigma2 can add: the bristle moves by at most its motion
      // and twice its bound.
      const double rate = motion.norm() / kTick_s;
      const double bend = std::min(rate, 2.0 * p.static_level * normal / 1e5 / kTick_s);
      const double bound =
          (p.static_level + p.damping_s_per_m * bend + p.viscous_s_per_m * rate) * normal;
      ASSERT_LE(result.force_N.norm(), bound * (1.0 + 1e-9)) << friction.name;
      ASSERT_LE(memory.elastic_force_N.norm(), p.static_level * normal * (1.0 + 1e-8));
    }
  }
}

// A mass thrown at up to 10 m/s, with no push: it comes to rest, and its energy only falls.
TEST(Limits, AThrownMassComesToRestAtOneKilohertz) {
  for (const NamedFriction& friction : every_kind(1e5)) {
    for (const double speed : {0.03, 1.0, 10.0}) {
      SlidingMass mass({.friction = friction.parameters, .mass_kg = 0.1, .normal_force_N = 5.0});
      mass.place(0.0, speed);
      double energy_J = mass.energy_J();
      for (int k = 0; k < 2000; ++k) {
        mass.step({}, kTick_s);
        ASSERT_LE(mass.energy_J(), energy_J * (1.0 + 1e-12) + 1e-15) << friction.name << " " << k;
        energy_J = mass.energy_J();
      }
      EXPECT_LE(std::fabs(mass.state().v_m_per_s), 0.03) << friction.name;
    }
  }
}

TEST(Limits, InvalidParametersAreFound) {
  const FrictionParameters good = every_kind(1000.0)[5].parameters;
  ASSERT_TRUE(valid(good));
  const auto refuses = [&](auto change) {
    FrictionParameters bad = good;
    change(bad);
    return !valid(bad);
  };
  EXPECT_TRUE(refuses([](auto& p) { p.coulomb = -0.1; }));
  EXPECT_TRUE(refuses([](auto& p) { p.static_level = 0.4; }));
  EXPECT_TRUE(refuses([](auto& p) { p.stiffness_N_per_m = 0.0; }));
  EXPECT_TRUE(refuses([](auto& p) { p.stribeck_velocity_m_per_s = 0.0; }));
  EXPECT_TRUE(refuses([](auto& p) { p.stribeck_exponent = 0.0; }));
  EXPECT_TRUE(refuses([](auto& p) { p.damping_s_per_m = std::nan(""); }));
  EXPECT_TRUE(
      refuses([](auto& p) { p.viscous_s_per_m = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refuses([](auto& p) { p.elastic_fraction = 1.0; }));
  EXPECT_TRUE(refuses([](auto& p) { p.stick_velocity_m_per_s = 0.0; }));
  EXPECT_TRUE(
      refuses([](auto& p) { p.kind = static_cast<FrictionKind>(rendering::kFrictionKinds); }));
}

}  // namespace
}  // namespace tactus::testing
