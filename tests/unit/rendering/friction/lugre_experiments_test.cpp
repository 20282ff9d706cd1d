// The experiments of the LuGre paper at the rates of controllers, against accurate solutions of the
// same equations (tests/reference/README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host_tools/friction/sliding_mass.h"
#include "tests/support/csv.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::testing {
namespace {

using host::SlidingMass;
using host::SlidingMassState;
using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::update_friction;

constexpr double kOnePercent = 0.01;

class LugreExperiments : public ::testing::TestWithParam<double> {
 protected:
  [[nodiscard]] double step_s() const { return 1.0 / GetParam(); }
};

void expect_within(double value, double reference, double relative, const char* what) {
  EXPECT_NEAR(value, reference, relative * std::fabs(reference)) << what;
}

// 0 to 1.425 N in 10 s, hold 5 s, to -1.425 N in 20 s, hold, and back, hold.
double presliding_push(double t) {
  constexpr double kPeak_N = 1.425;
  if (t < 15.0) {
    return kPeak_N * std::min(1.0, t / 10.0);
  }
  if (t < 40.0) {
    return kPeak_N * std::max(-1.0, 1.0 - (t - 15.0) / 10.0);
  }
  return kPeak_N * std::min(1.0, -1.0 + (t - 40.0) / 10.0);
}

void expect_presliding_loop(double step_s) {
  const Csv csv("lugre_presliding_fig2.csv");
  SlidingMass mass({.friction = published(FrictionKind::lugre)});
  double loop_J = 0.0;
  std::size_t row = 1;
  const auto steps = static_cast<std::size_t>(std::lround(65.0 / step_s));
  for (std::size_t k = 0; k < steps; ++k) {
    const SlidingMassState before = mass.state();
    const SlidingMassState& after =
        mass.step({.push_N = presliding_push(before.time_s + 0.5 * step_s)}, step_s);
    if (before.time_s >= 15.0) {
      loop_J += after.friction.mean_force_N * (after.x_m - before.x_m);
    }
    for (; row < csv.rows() && csv.number(row, "t_s") <= after.time_s; ++row) {
      const double share = (csv.number(row, "t_s") - before.time_s) / step_s;
      EXPECT_NEAR(std::lerp(before.x_m, after.x_m, share), csv.number(row, "x_m"),
                  kOnePercent * 45e-6)
          << "row " << row;
    }
  }
  EXPECT_GE(row, csv.rows() - 1);
  expect_within(mass.state().x_m, 45.3119e-6, kOnePercent, "x at the end");
  expect_within(loop_J, 8.0478e-5, kOnePercent, "loop");
}

TEST(LugreRuns, PreslidingFollowsTheCurveAndItsLoop) {
  for (const double rate_Hz : part_of(kRates_Hz)) {
    SCOPED_TRACE(rate_Hz);
    expect_presliding_loop(1.0 / rate_Hz);
  }
}

TEST_P(LugreExperiments, FrictionLagsBehindTheVelocity) {
  const Csv csv("lugre_friction_lag_scalars.csv");
  const double omega = csv.number(0, "omega_rad_s");
  const auto parameters = published(FrictionKind::lugre);
  FrictionMemory<double> state;
  std::vector<double> velocity;
  std::vector<double> force;
  const auto motion = [&](double t) { return 1e-3 * (1.5 * t + std::sin(omega * t) / omega); };
  const double period_s = 2.0 * M_PI / omega;
  const auto steps = static_cast<std::size_t>(std::ceil(2.0 * period_s / step_s()));
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) * step_s();
    const double displacement = motion(t + step_s()) - motion(t);
    const auto result = update_friction(parameters, state, displacement, 1.0, step_s());
    if (t >= period_s) {
      // The mean over the tick belongs to its middle.
      velocity.push_back(displacement / step_s());
      force.push_back(result.mean_force_N);
    }
  }
  const auto at = [&](double v, bool rising) {
    for (std::size_t k = 1; k < velocity.size(); ++k) {
      const double before = velocity[k - 1];
      const double after = velocity[k];
      if (rising ? (before < v && after >= v) : (before > v && after <= v)) {
        return std::lerp(force[k - 1], force[k], (v - before) / (after - before));
      }
    }
    return std::nan("");
  };
  const std::array levels{0.001, 0.0015, 0.002};
  const std::array names{"0.001", "0.0015", "0.002"};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double falling = csv.number(0, std::string("dec_") + names[i]);
    const double rising = csv.number(0, std::string("inc_") + names[i]);
    expect_within(at(levels[i], false), falling, 2e-4, names[i]);
    expect_within(at(levels[i], true), rising, 2e-4, names[i]);
    expect_within(at(levels[i], true) - at(levels[i], false), rising - falling, 0.05, "lag");
  }
  expect_within(*std::ranges::max_element(force), csv.number(0, "Fmax"), 1e-3, "Fmax");
  double area = 0.0;
  for (std::size_t k = 1; k < force.size(); ++k) {
    area += 0.5 * (force[k] + force[k - 1]) * (velocity[k] - velocity[k - 1]);
  }
  expect_within(std::fabs(area), csv.number(0, "loop_area_N_m_per_s"), kOnePercent, "area");
}

TEST_P(LugreExperiments, BreakAwayFallsWithTheRateOfTheForce) {
  const Csv csv("lugre_breakaway_fig4.csv");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double rate = csv.number(row, "force_rate_N_s");
    SlidingMass mass({.friction = published(FrictionKind::lugre)});
    double peak_N = 0.0;
    double at_s = 0.0;
    while (mass.state().time_s < 1.2 * csv.number(row, "t_first_local_max_s")) {
      const double push_N = rate * (mass.state().time_s + 0.5 * step_s());
      const double force_N = mass.step({.push_N = push_N}, step_s()).friction.mean_force_N;
      if (force_N < peak_N) {
        break;
      }
      peak_N = force_N;
      at_s = mass.state().time_s - 0.5 * step_s();
    }
    expect_within(peak_N, csv.number(row, "F_first_local_max_N"), kOnePercent, "peak");
    EXPECT_NEAR(at_s, csv.number(row, "t_first_local_max_s"),
                0.01 * csv.number(row, "t_first_local_max_s") + step_s());
  }
}

void expect_stick_slip(double step_s) {
  constexpr double kSlips_m_per_s = 0.01;
  const Csv csv("lugre_stickslip_events.csv");
  SlidingMass mass({.friction = published(FrictionKind::lugre), .spring_N_per_m = 2.0});
  std::vector<double> starts;
  std::vector<double> ends;
  std::vector<double> begins_m;
  std::vector<double> ends_m;
  double fastest = 0.0;
  double strongest_N = 0.0;
  while (mass.state().time_s < 36.0) {
    const SlidingMassState before = mass.state();
    const SlidingMassState& after =
        mass.step({.spring_end_m = 0.1 * (before.time_s + 0.5 * step_s)}, step_s);
    fastest = std::max(fastest, after.v_m_per_s);
    strongest_N = std::max(strongest_N, after.friction.mean_force_N);
    const bool was_fast = before.v_m_per_s >= kSlips_m_per_s;
    const bool is_fast = after.v_m_per_s >= kSlips_m_per_s;
    if (was_fast != is_fast) {
      const double share =
          (kSlips_m_per_s - before.v_m_per_s) / (after.v_m_per_s - before.v_m_per_s);
      (is_fast ? starts : ends).push_back(before.time_s + share * step_s);
      (is_fast ? begins_m : ends_m).push_back(std::lerp(before.x_m, after.x_m, share));
    }
  }
  ASSERT_EQ(starts.size(), 5U);
  ASSERT_EQ(ends.size(), 5U);
  expect_within(starts[0], csv.number(0, "t_v_up_0.01_s"), 1e-3, "first slip");
  expect_within(fastest, csv.number(1, "v_peak_m_s"), 1e-3, "peak speed");
  expect_within(strongest_N, csv.number(1, "F_peak_N"), 1e-2, "peak friction");
  for (std::size_t i = 1; i < starts.size(); ++i) {
    expect_within(starts[i] - starts[i - 1], csv.number(1, "period_s"), 1e-3, "period");
    expect_within(ends[i] - starts[i], csv.number(1, "slip_duration_s"), 1e-3, "slip");
    expect_within(ends_m[i] - begins_m[i], csv.number(1, "slip_distance_m"), 1e-3, "distance");
  }
}

TEST(LugreRuns, StickSlipHasThePeriodAndTheAmplitude) {
  for (const double rate_Hz : part_of(kRates_Hz)) {
    SCOPED_TRACE(rate_Hz);
    ASSERT_NO_FATAL_FAILURE(expect_stick_slip(1.0 / rate_Hz));
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, LugreExperiments, ::testing::ValuesIn(kRates_Hz),
                         [](const auto& rate) {
                           return std::to_string(std::lround(rate.param)) + "Hz";
                         });

}  // namespace
}  // namespace tactus::testing
