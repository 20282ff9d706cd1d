// The published experiments as `tactus friction` runs them, within 1 percent of accurate solutions
// and closed forms.
#include "host_tools/friction/experiments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/csv.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using testing::contains;
using testing::Csv;
using testing::input_error;
using testing::published;

class Published : public ::testing::TestWithParam<double> {
 protected:
  static ExperimentResult run(std::string_view name, FrictionKind kind, double rate_hz,
                              std::span<const char* const> setup = {}) {
    const Experiment& known = experiment(name);
    auto friction = published(kind);
    if (kind == FrictionKind::karnopp) {
      friction.stiffness_N_per_m = 0.0;
    }
    ExperimentRun run{.friction = friction, .rate_hz = rate_hz, .setup = known.setup()};
    for (const char* assignment : setup) {
      run.setup.set(assignment);
    }
    return known.run(run);
  }
};

double found(const ExperimentResult& result, std::size_t row, std::string_view column) {
  const auto at = std::ranges::find(result.findings.columns, column);
  EXPECT_NE(at, result.findings.columns.end()) << column;
  return result.findings.rows.at(row).at(
      static_cast<std::size_t>(at - result.findings.columns.begin()));
}

void expect_near_percent(double value, double reference, const char* what) {
  EXPECT_NEAR(value, reference, 0.01 * std::fabs(reference)) << what;
}

TEST_P(Published, Presliding) {
  const ExperimentResult result = run("presliding", FrictionKind::lugre, GetParam());
  expect_near_percent(found(result, 0, "x_after_ramp_m"), 44.8579e-6, "ramp");
  expect_near_percent(found(result, 0, "x_after_hold_m"), 45.3119e-6, "hold");
  expect_near_percent(found(result, 0, "x_after_ramp_down_m"), -9.5635e-6, "down");
  expect_near_percent(found(result, 0, "x_after_hold_down_m"), -10.0174e-6, "hold down");
  expect_near_percent(found(result, 0, "x_after_ramp_up_m"), 44.8579e-6, "up");
  expect_near_percent(found(result, 0, "x_at_end_m"), 45.3119e-6, "end");
  expect_near_percent(found(result, 0, "loop_area_J"), 8.0478e-5, "area");
}

TEST_P(Published, FrictionalLag) {
  const Csv csv("lugre_friction_lag_scalars.csv");
  const ExperimentResult result = run("lag", FrictionKind::lugre, GetParam());
  ASSERT_EQ(result.findings.rows.size(), 3U);
  expect_near_percent(found(result, 0, "force_max_N"), csv.number(0, "Fmax"), "max");
  expect_near_percent(found(result, 0, "falling_at_low_speed_N"), csv.number(0, "dec_0.001"), "1");
  expect_near_percent(found(result, 0, "rising_at_low_speed_N"), csv.number(0, "inc_0.001"), "1");
  expect_near_percent(found(result, 0, "falling_at_mean_N"), csv.number(0, "dec_0.0015"), "1.5");
  expect_near_percent(found(result, 0, "rising_at_high_speed_N"), csv.number(0, "inc_0.002"), "2");
  expect_near_percent(found(result, 0, "loop_area_N_m_per_s"), csv.number(0, "loop_area_N_m_per_s"),
                      "area");
  EXPECT_GT(found(result, 1, "loop_area_N_m_per_s"), found(result, 0, "loop_area_N_m_per_s"));
  EXPECT_GT(found(result, 2, "loop_area_N_m_per_s"), found(result, 1, "loop_area_N_m_per_s"));
}

TEST_P(Published, BreakAway) {
  const Csv csv("lugre_breakaway_fig4.csv");
  const std::array setup{"rates_N_per_s=1,5,20,50"};
  const ExperimentResult result = run("break-away", FrictionKind::lugre, GetParam(), setup);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    EXPECT_EQ(found(result, row, "rate_N_per_s"), csv.number(row, "force_rate_N_s"));
    expect_near_percent(found(result, row, "break_away_N"), csv.number(row, "F_first_local_max_N"),
                        "force");
  }
  EXPECT_NEAR(found(result, 3, "break_away_N"), 1.0, 0.02) << "toward Fc";
}

TEST_P(Published, StickSlip) {
  const Csv csv("lugre_stickslip_events.csv");
  const ExperimentResult result = run("stick-slip", FrictionKind::lugre, GetParam());
  ASSERT_EQ(result.findings.rows.size(), 5U);
  expect_near_percent(found(result, 0, "start_s"), csv.number(0, "t_v_up_0.01_s"), "start");
  for (std::size_t slip = 1; slip < 5; ++slip) {
    expect_near_percent(found(result, slip, "period_s"), csv.number(1, "period_s"), "period");
    expect_near_percent(found(result, slip, "duration_s"), csv.number(1, "slip_duration_s"),
                        "slip");
    expect_near_percent(found(result, slip, "slip_distance_m"), csv.number(1, "slip_distance_m"),
                        "distance");
    expect_near_percent(found(result, slip, "peak_speed_m_per_s"), csv.number(1, "v_peak_m_s"),
                        "speed");
    expect_near_percent(found(result, slip, "peak_friction_N"), csv.number(1, "F_peak_N"), "force");
  }
}

TEST_P(Published, KarnoppsStickSlipIsTheClosedForm) {
  const ExperimentResult result = run("stick-slip", FrictionKind::karnopp, GetParam());
  ASSERT_GE(result.findings.rows.size(), 3U);
  for (std::size_t slip = 1; slip < 3; ++slip) {
    expect_near_percent(found(result, slip, "period_s"), 6.453932708, "period");
    expect_near_percent(found(result, slip, "slip_distance_m"), 0.645393271, "distance");
    expect_near_percent(found(result, slip, "peak_speed_m_per_s"), 0.376819, "speed");
  }
}

TEST_P(Published, HysteresisIsDahlsClosedForm) {
  const Csv csv("dahl_loop_analytic.csv");
  const std::array setup{"amplitudes_m=1e-5,2e-5,1e-3"};
  const ExperimentResult result = run("hysteresis", FrictionKind::dahl, GetParam(), setup);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (csv.number(row, "amplitude_m") == found(result, i, "amplitude_m")) {
        expect_near_percent(found(result, i, "turning_force_N"),
                            csv.number(row, "F_turning_N_analytic"), "force");
        expect_near_percent(found(result, i, "loop_area_J"),
                            csv.number(row, "loop_area_J_analytic"), "area");
      }
    }
  }
}

TEST_P(Published, HuntingNeverEndsWithLugreAndIsSymmetric) {
  const ExperimentResult result = run("hunting", FrictionKind::lugre, GetParam());
  const double above = found(result, 0, "highest_above_target_m");
  EXPECT_GT(above, 0.03);
  EXPECT_NEAR(found(result, 0, "lowest_below_target_m"), above, 0.01 * above);
  // While it sticks the integral must turn from Fs on one side to Fs on the other.
  EXPECT_GT(found(result, 0, "period_s"), 10.0);
}

INSTANTIATE_TEST_SUITE_P(Rates, Published, ::testing::Values(1000.0, 4000.0), [](const auto& rate) {
  return std::to_string(std::lround(rate.param)) + "Hz";
});

TEST(Experiments, EveryOneRunsWithEveryModel) {
  for (const Experiment& known : experiments()) {
    for (std::size_t kind = 0; kind < rendering::kFrictionKinds; ++kind) {
      ExperimentRun run{.friction = published(static_cast<FrictionKind>(kind)),
                        .setup = known.setup()};
      const auto values = run.setup.values();
      if (std::ranges::find(values, "seconds", &SetupValue::name) != values.end()) {
        run.setup.set("seconds=10");
      }
      const ExperimentResult result = known.run(run);
      EXPECT_FALSE(result.track.samples.empty()) << known.name << kind;
      for (const FrictionSample& sample : result.track.samples) {
        ASSERT_TRUE(std::isfinite(sample.force_N) && std::isfinite(sample.x_m))
            << known.name << kind;
      }
      for (const NamedColumn& column : result.track.more) {
        EXPECT_EQ(column.values.size(), result.track.samples.size()) << column.name;
      }
    }
  }
}

TEST(Experiments, ASetupTakesNumbersAndLists) {
  host::Setup setup = experiment("break_away").setup();
  setup.set("rates_N_per_s=1,2.5");
  EXPECT_EQ(setup.list("rates_N_per_s"), (std::vector<double>{1.0, 2.5}));
  const auto complaint = [&setup](const char* text) {
    return input_error([&] { setup.set(text); });
  };
  EXPECT_TRUE(contains(complaint("rate=1"), "it has rates_N_per_s, sliding_m_per_s"));
  EXPECT_TRUE(contains(complaint("rates_N_per_s=1,,2"), "'' is not a number above 0"));
  EXPECT_TRUE(contains(complaint("sliding_m_per_s=1,2"), "sliding_m_per_s is one number"));
  EXPECT_TRUE(contains(complaint("sliding_m_per_s"), "write NAME=VALUE"));
  EXPECT_TRUE(contains(input_error([] { experiment("waltz"); }), "there are presliding, lag"));
}

}  // namespace
}  // namespace tactus::host
