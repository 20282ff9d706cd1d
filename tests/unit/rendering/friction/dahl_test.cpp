// Dahl's model against its closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rendering/friction/friction_model.h"
#include "tests/support/csv.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::update_friction;

FrictionParameters dahl() {
  FrictionParameters parameters = published(FrictionKind::dahl);
  parameters.viscous_s_per_m = 0.0;
  return parameters;
}

// One stroke in `ticks` equal steps; the work done on the friction.
double stroke(const FrictionParameters& parameters, FrictionMemory<double>& state, double path_m,
              int ticks) {
  double work_J = 0.0;
  for (int k = 0; k < ticks; ++k) {
    const double displacement = path_m / ticks;
    work_J +=
        update_friction(parameters, state, displacement, 1.0, kTick_s).mean_force_N * displacement;
  }
  return work_J;
}

TEST(Dahl, FollowsTheClosedFormThroughRandomReversals) {
  constexpr std::uint64_t kSeed = 20261121;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::lognormal_distribution<double> size(std::log(1e-5), 2.0);
  const FrictionParameters parameters = dahl();
  FrictionMemory<double> state;
  long double force = 0.0L;
  double sign = 1.0;
  for (int i = 0; i < 100'000; ++i) {
    sign = random() % 4 == 0 ? -sign : sign;
    const double displacement = sign * size(random);
    const auto limit = static_cast<long double>(sign * parameters.coulomb);
    const auto exponent = static_cast<long double>(parameters.stiffness_N_per_m) *
                          std::fabs(static_cast<long double>(displacement)) / fabsl(limit);
    force = limit + (force - limit) * std::exp(-exponent);
    const auto result = update_friction(parameters, state, displacement, 1.0, kTick_s);
    ASSERT_NEAR(result.force_N, static_cast<double>(force), 1e-14) << i;
  }
}

TEST(Dahl, FollowsTheLoop) {
  const Csv csv("dahl_loop_A20um.csv");
  const FrictionParameters parameters = dahl();
  FrictionMemory<double> state;
  for (int cycle = 0; cycle < 10; ++cycle) {
    stroke(parameters, state, -40e-6, 1);
    if (cycle < 9) {
      stroke(parameters, state, 40e-6, 1);
    }
  }
  double x = -20e-6;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double displacement = csv.number(row, "x_m") - x;
    x = csv.number(row, "x_m");
    const auto result = update_friction(parameters, state, displacement, 1.0, kTick_s);
    ASSERT_NEAR(result.force_N, csv.number(row, "F_N"), 1e-9) << "row " << row;
    ASSERT_NEAR(result.bristle_m, csv.number(row, "z_m"), 1e-14) << "row " << row;
  }
}

TEST(Dahl, LoopsTakeTheirAreaHoweverManyTicksTheyHave) {
  const Csv csv("dahl_loop_analytic.csv");
  const FrictionParameters parameters = dahl();
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double amplitude = csv.number(row, "amplitude_m");
    for (const int ticks : {1, 7, 1000}) {
      FrictionMemory<double> state;
      stroke(parameters, state, amplitude, 1);
      for (int cycle = 0; cycle < 100; ++cycle) {
        stroke(parameters, state, -2.0 * amplitude, 1);
        stroke(parameters, state, 2.0 * amplitude, 1);
      }
      EXPECT_NEAR(state.elastic_force_N, csv.number(row, "F_turning_N_analytic"), 1e-9);
      const double area = stroke(parameters, state, -2.0 * amplitude, ticks) +
                          stroke(parameters, state, 2.0 * amplitude, ticks);
      // The table has twelve digits, and a large loop's end is its beginning to rounding.
      EXPECT_NEAR(area, csv.number(row, "loop_area_J_analytic"), 5e-12 * area + 1e-18) << ticks;
    }
  }
}

// The path from one force to another, by halving: the force grows along the path.
double path_to(const FrictionParameters& parameters, FrictionMemory<double>& state,
               double force_N) {
  const double direction = force_N > state.elastic_force_N ? 1.0 : -1.0;
  double lower = 0.0;
  double upper = 0.1;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (lower + upper);
    FrictionMemory<double> trial = state;
    update_friction(parameters, trial, direction * middle, 1.0, 1e9);
    (direction * (trial.elastic_force_N - force_N) < 0.0 ? lower : upper) = middle;
  }
  update_friction(parameters, state, direction * lower, 1.0, 1e9);
  return direction * lower;
}

// So slowly that LuGre's level is Fs, Dahl's with Fs for Fc and LuGre creep alike.
TEST(Dahl, CreepsByTheClosedFormUnderACyclingForceAndSoDoesLugre) {
  const Csv csv("drift_quasistatic_per_cycle.csv");
  FrictionParameters dahls = dahl();
  dahls.coulomb = 1.5;
  for (const FrictionParameters& parameters : {dahls, published(FrictionKind::lugre)}) {
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      FrictionMemory<double> state;
      path_to(parameters, state, csv.number(row, "F_low_N"));
      const double creep = path_to(parameters, state, csv.number(row, "F_high_N")) +
                           path_to(parameters, state, csv.number(row, "F_low_N"));
      EXPECT_NEAR(creep, csv.number(row, "drift_per_cycle_m(Fs=1.5,sigma0=1e5)"), 1e-14);
    }
  }
}

TEST(Dahl, CreepIsThatOfTheTableUnderAHapticStiffness) {
  const Csv csv("drift_quasistatic_per_cycle.csv");
  FrictionParameters parameters = dahl();
  parameters.coulomb = 1.5;
  parameters.stiffness_N_per_m = 1000.0;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    FrictionMemory<double> state;
    state.elastic_force_N = csv.number(row, "F_low_N");
    const double creep = path_to(parameters, state, csv.number(row, "F_high_N")) +
                         path_to(parameters, state, csv.number(row, "F_low_N"));
    EXPECT_NEAR(1e3 * creep, csv.number(row, "drift_per_cycle_mm(Fs=1.5,sigma0=1000)"), 1e-9);
  }
}

}  // namespace
}  // namespace tactus::testing
