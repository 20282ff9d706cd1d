#include "firmware/safety/energy_account.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace tactus::firmware {
namespace {

constexpr double kStep_s = 0.001;

double of(const EnergyAccount& account, EnergySource source) {
  return account.ledger_J()[static_cast<std::size_t>(source)];
}

rendering::Touch spring_at(const Vec3& p_W, double stiffness_N_per_m) {
  rendering::Touch touch;
  touch.force_W = -stiffness_N_per_m * p_W;
  return touch;
}

// A spring held from tick to tick gives K dx^2 / 2 a step, in and out alike: the closed form of the
// sampled wall's energy. The spring itself gives back what it took.
TEST(EnergyAccount, ASampledSpringsSurplusIsDelayAndNothingElse) {
  constexpr double kWallStiffness = 800.0;
  EnergyAccount account;
  account.restart();
  double squares = 0.0;
  double before = 0.0;
  double given = 0.0;
  for (int tick = 0; tick <= 200; ++tick) {
    const double x = 0.004 * std::sin(M_PI * tick / 200.0);
    const rendering::Touch touch = spring_at({x, 0.0, 0.0}, kWallStiffness);
    given += account.settle({x, 0.0, 0.0}, touch, kStep_s).given_J;
    account.hold(touch.force_W);
    squares += (x - before) * (x - before);
    before = x;
  }
  EXPECT_NEAR(of(account, EnergySource::delay), 0.5 * kWallStiffness * squares, 1e-12);
  EXPECT_NEAR(of(account, EnergySource::contact), 0.0, 1e-12);
  EXPECT_NEAR(given, 0.5 * kWallStiffness * squares, 1e-12);
  EXPECT_EQ(account.most_giving(), EnergySource::delay);
}

// At a steady speed a spring held for a tick and late by d gives K v^2 T (T / 2 + d) more a tick
// than it takes.
TEST(EnergyAccount, ADeviceThatAnswersLateGivesWhatTheDelayMakes) {
  constexpr double kWallStiffness = 800.0;
  constexpr double kWay = 1e-4;
  for (const double delay_ticks : {0.0, 0.5, 1.0, 1.5, 4.25, 8.0}) {
    ControllerConfig config;
    config.safety.device_delay_s = kStep_s * delay_ticks;
    EnergyAccount account;
    account.configure(config);
    double given = 0.0;
    double instant = 0.0;
    for (int tick = 0; tick <= 120; ++tick) {
      const double x = kWay * tick;
      const rendering::Touch touch = spring_at({x, 0.0, 0.0}, kWallStiffness);
      const TickEnergy energy = account.settle({x, 0.0, 0.0}, touch, kStep_s);
      account.hold(touch.force_W);
      if (tick > 20) {
        given += energy.given_J;
        instant -= kWallStiffness * (x - 0.5 * kWay) * kWay;
      }
    }
    EXPECT_NEAR(given - instant, 100.0 * kWallStiffness * kWay * kWay * (0.5 + delay_ticks), 1e-12);
  }
}

TEST(EnergyAccount, TheSourcesAddUpToWhatTheHeldForceGave) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto random_vector = [&] {
    return Vec3(unit(generator), unit(generator), unit(generator));
  };
  EnergyAccount account;
  Vec3 held = Vec3::Zero();
  Vec3 p = Vec3::Zero();
  double by_hand = 0.0;
  double settled = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    const Vec3 next = p + 0.001 * random_vector();
    by_hand += held.dot(next - p);
    rendering::Touch touch;
    touch.force_W = random_vector();
    touch.parts = {.friction_W = random_vector(),
                   .texture_W = random_vector(),
                   .effect_W = random_vector(),
                   .driven_power = unit(generator)};
    settled += account.settle(next, touch, kStep_s).given_J;
    held = random_vector();
    account.hold(held);
    p = next;
  }
  const EnergyLedger& ledger = account.ledger_J();
  EXPECT_NEAR(std::accumulate(ledger.begin(), ledger.end(), 0.0), by_hand, 1e-12);
  EXPECT_NEAR(settled, by_hand, 1e-12);
}

// A lift that pushes the tool up by 10 mm with 2 N.
TEST(EnergyAccount, WhatASurfaceThatMovesGivesIsCouplingAndNeedNotBePassive) {
  EnergyAccount account;
  double passive = 0.0;
  rendering::Touch touch;
  touch.force_W = {0.0, 2.0, 0.0};
  touch.parts.driven_power = 2.0 * 0.1;
  for (int tick = 0; tick <= 100; ++tick) {
    passive += account.settle({0.0, 1e-4 * tick, 0.0}, touch, kStep_s).passive_J;
    account.hold(touch.force_W);
  }
  EXPECT_NEAR(of(account, EnergySource::coupling), 0.02, 1e-12);
  EXPECT_NEAR(of(account, EnergySource::contact), 0.0, 1e-12);
  EXPECT_NEAR(passive, 0.0, 1e-12);
}

TEST(EnergyAccount, WhatLimitsTakeAwayScalesTheSourcesAndWhatIsAddedIsSafety) {
  EnergyAccount account;
  rendering::Touch touch;
  touch.force_W = {4.0, 0.0, 0.0};
  account.settle(Vec3::Zero(), touch, kStep_s);
  account.hold({1.0, 3.0, 0.0});
  account.settle({0.01, 0.01, 0.0}, touch, kStep_s);
  EXPECT_NEAR(of(account, EnergySource::contact), 0.01, 1e-15);
  EXPECT_NEAR(of(account, EnergySource::safety), 0.03, 1e-15);
}

// 4 N that act three ticks late, then an activation 20 mm away.
TEST(EnergyAccount, ARestartForgetsWhereTheToolWasAndWhatStillActs) {
  ControllerConfig config;
  config.safety.device_delay_s = 3.0 * kStep_s;
  EnergyAccount account;
  account.configure(config);
  rendering::Touch touch;
  touch.force_W = {4.0, 0.0, 0.0};
  for (int tick = 0; tick < 20; ++tick) {
    account.settle({0.001 * tick, 0.0, 0.0}, touch, kStep_s);
    account.hold(touch.force_W);
  }
  account.restart();
  touch.force_W.setZero();
  for (int tick = 0; tick < 10; ++tick) {
    const TickEnergy energy = account.settle({0.03 + 0.001 * tick, 0.0, 0.0}, touch, kStep_s);
    EXPECT_EQ(energy.given_J, 0.0) << tick;
    EXPECT_NEAR(energy.way_m2, tick == 0 ? 0.0 : 1e-6, 1e-15) << tick;
    account.hold(Vec3::Zero());
  }
}

TEST(StrongestPart, IsTheLargestForceOfAllSources) {
  rendering::Touch touch;
  touch.force_W = {0.0, 3.0, 0.0};
  EXPECT_EQ(strongest_part(touch, Vec3::Zero()), EnergySource::contact);
  touch.parts.friction_W = {2.0, 0.0, 0.0};
  touch.parts.effect_W = {0.0, 2.9, 0.0};
  EXPECT_EQ(strongest_part(touch, Vec3::Zero()), EnergySource::effect);
  EXPECT_EQ(strongest_part(touch, {0.0, 0.0, 5.0}), EnergySource::safety);
}

}  // namespace
}  // namespace tactus::firmware
