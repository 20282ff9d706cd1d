// The elasto-plastic model: no drift, and what the accurate solutions say of the little there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host_tools/friction/sliding_mass.h"
#include "tests/support/csv.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using host::SlidingMass;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::update_friction;

// A force that is ramped to its mean in a second and then swings.
struct Swing {
  double mean_N;
  double amplitude_N;
  double frequency_Hz;
};

double push(const Swing& swing, double t) {
  if (t < 1.0) {
    // The smooth step of the reference.
    return swing.mean_N * t * t * (3.0 - 2.0 * t);
  }
  return swing.mean_N + swing.amplitude_N * std::sin(2.0 * M_PI * swing.frequency_Hz * (t - 1.0));
}

double drift_per_cycle(FrictionKind kind, const Swing& swing, double rate_Hz) {
  SlidingMass mass({.friction = published(kind)});
  const auto run_to = [&](double end_s) {
    while (mass.state().time_s < end_s - 0.5 / rate_Hz) {
      mass.step({.push_N = push(swing, mass.state().time_s + 0.5 / rate_Hz)}, 1.0 / rate_Hz);
    }
    return mass.state().x_m;
  };
  const double start = run_to(1.0 + 10.0 / swing.frequency_Hz);
  return (run_to(1.0 + 20.0 / swing.frequency_Hz) - start) / 10.0;
}

TEST(ElastoPlastic, DoesNotCreepUnderAForceBelowItsBreakAwayWhereLugreDoes) {
  for (const double rate : part_of(kRates_Hz)) {
    const Swing slow{.mean_N = 0.35, .amplitude_N = 0.3, .frequency_Hz = 2.0};
    EXPECT_NEAR(drift_per_cycle(FrictionKind::lugre, slow, rate), 3.1115e-6, 0.01 * 3.1115e-6);
    EXPECT_LE(std::fabs(drift_per_cycle(FrictionKind::elasto_plastic, slow, rate)), 1e-14);
    const Swing fast{.mean_N = 0.35, .amplitude_N = 0.3, .frequency_Hz = 10.0};
    EXPECT_NEAR(drift_per_cycle(FrictionKind::lugre, fast, rate), 3.3281e-6, 0.01 * 3.3281e-6);
    EXPECT_LE(std::fabs(drift_per_cycle(FrictionKind::elasto_plastic, fast, rate)), 1e-14);
  }
}

TEST(ElastoPlastic, CreepsALittleWhereTheForcePassesItsBreakAway) {
  for (const double rate : part_of(kRates_Hz)) {
    const Swing swing{.mean_N = 0.5, .amplitude_N = 0.3, .frequency_Hz = 2.0};
    EXPECT_NEAR(drift_per_cycle(FrictionKind::lugre, swing, rate), 4.7682e-6, 0.01 * 4.7682e-6);
    EXPECT_NEAR(drift_per_cycle(FrictionKind::elasto_plastic, swing, rate), 0.0067e-6, 0.0005e-6);
  }
}

TEST(ElastoPlastic, FollowsTheAccurateSolutionOfTheSwing) {
  const Csv csv("drift_mean0.35_amp0.3_f2.csv");
  const Swing swing{.mean_N = 0.35, .amplitude_N = 0.3, .frequency_Hz = 2.0};
  for (const auto kind : {FrictionKind::lugre, FrictionKind::elasto_plastic}) {
    const std::string name = kind == FrictionKind::lugre ? "lugre_m" : "elastoplastic_m";
    SlidingMass mass({.friction = published(kind)});
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      while (mass.state().time_s < csv.number(row, "t_s") - 0.5e-3) {
        mass.step({.push_N = push(swing, mass.state().time_s + 0.5e-3)}, 1e-3);
      }
      ASSERT_NEAR(mass.state().x_m, csv.number(row, "x_" + name),
                  0.01 * csv.number(row, "x_" + name) + 1e-9)
          << name << " row " << row;
      ASSERT_NEAR(mass.state().friction.bristle_m, csv.number(row, "z_" + name), 2e-8)
          << name << " row " << row;
    }
  }
}

// Returns the bristle by Dupont's equation, with Runge and Kutta's fourth-order rule in steps of a
// thousandth of a bristle.
double bristle_after(const FrictionParameters& p, double level_N, double z, double path_m) {
  const double steady = level_N / p.stiffness_N_per_m;
  const double elastic = p.elastic_fraction * p.coulomb / p.stiffness_N_per_m;
  const double sign = path_m < 0.0 ? -1.0 : 1.0;
  const std::function<double(double)> slope = [&](double at) {
    double alpha = 0.0;
    if (at * sign > elastic) {
      alpha = at * sign >= steady
                  ? 1.0
                  : 0.5 + 0.5 * std::sin(M_PI * (at * sign - 0.5 * (steady + elastic)) /
                                         (steady - elastic));
    }
    return sign * (1.0 - alpha * at * sign / steady);
  };
  const int steps = 1 + static_cast<int>(std::fabs(path_m) / (2e-2 * steady));
  const double h = std::fabs(path_m) / steps;
  for (int k = 0; k < steps; ++k) {
    const double a = slope(z);
    const double b = slope(z + 0.5 * h * a);
    const double c = slope(z + 0.5 * h * b);
    const double d = slope(z + h * c);
    z += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return z;
}

TEST(ElastoPlastic, FollowsItsEquationInSmallAndInLargeTicks) {
  FrictionParameters parameters = published(FrictionKind::elasto_plastic);
  parameters.damping_s_per_m = 0.0;
  parameters.viscous_s_per_m = 0.0;
  for (const double motion : {2e-7, 1e-6, 5e-6, 2e-5, 1e-4, 6e-4}) {
    for (const double speed : {1e-5, 1e-3, 0.1}) {
      FrictionMemory<double> memory;
      double z = 0.0;
      double worst = 0.0;
      for (int k = 0; k < 300; ++k) {
        const double step = (k / 40) % 2 == 0 ? motion : -motion;
        z = bristle_after(parameters, steady_level(parameters, speed), z, step);
        const auto result = update_friction(parameters, memory, step, 1.0, motion / speed);
        worst = std::max(worst, std::fabs(result.bristle_m - z));
      }
      // The bristle is about 10 um: small ticks are nearly exact, large ones are good to a percent.
      EXPECT_LE(worst, motion <= 2e-7 ? 2e-9 : 1.5e-7) << motion << " " << speed;
    }
  }
}

}  // namespace
}  // namespace tactus::testing
