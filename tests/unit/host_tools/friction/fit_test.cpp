// Fits must find what was planted, under noise of 5 percent, and say what cannot be found.
#include "host_tools/friction/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "host_tools/friction/fit_report.h"
#include "tests/support/share.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"
#include "tests/unit/host_tools/friction/noisy_record.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using testing::contains;
using testing::noisy_record;
using testing::published;
using testing::RecordPlan;

std::vector<std::uint64_t> seeds() {
  std::vector<std::uint64_t> all{11, 12, 13};
  all.resize(testing::part_of(all.size()));
  return all;
}

// Swings about the start, ever wider: from presliding, 6 um, to strokes of 5 mm at up to 50 mm/s.
double widening_swings(double t_s) {
  const double amplitude_m = 6e-6 * std::exp(t_s / 10.0 * std::log(800.0));
  return amplitude_m * std::sin(2.0 * std::numbers::pi * 1.6 * t_s) * (1.0 - std::exp(-4.0 * t_s));
}

RecordPlan plan_for(FrictionKind kind, std::uint64_t seed) {
  auto friction = published(kind);
  const bool is_rigid = kind == FrictionKind::coulomb_viscous || kind == FrictionKind::stribeck;
  friction.stiffness_N_per_m = is_rigid ? 0.0 : friction.stiffness_N_per_m;
  friction.viscous_s_per_m = 4.0;  // a tenth of the force at the end: enough to be told
  return {.friction = friction, .x_m = widening_swings, .seed = seed};
}

// Expects a value within `bound` of the planted one, and an interval not far from it.
void expect_found(const FrictionFit& fit, std::string_view symbol, double planted, double bound) {
  const FittedParameter& p = fit.parameter(symbol);
  ASSERT_EQ(p.knowledge, Knowledge::fitted) << symbol << ": " << p.why_unknown;
  EXPECT_NEAR(p.value, planted, bound * planted) << symbol;
  EXPECT_LT(p.low, p.value) << symbol;
  EXPECT_GT(p.high, p.value) << symbol;
  // Three times as far as the interval reaches: chance does not get there.
  EXPECT_GT(planted, p.value * std::pow(p.low / p.value, 3.0)) << symbol;
  EXPECT_LT(planted, p.value * std::pow(p.high / p.value, 3.0)) << symbol;
}

TEST(Fit, FindsCoulombAndViscous) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const FrictionFit fit = fit_friction(
        noisy_record(plan_for(FrictionKind::coulomb_viscous, seed)), FrictionKind::coulomb_viscous);
    EXPECT_TRUE(fit.has_converged);
    expect_found(fit, "Fc", 1.0, 0.01);
    expect_found(fit, "sigma2", 4.0, 0.1);
    EXPECT_NEAR(fit.residual_N, 0.05, 0.005);
  }
}

TEST(Fit, FindsStribeck) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const FrictionFit fit =
        fit_friction(noisy_record(plan_for(FrictionKind::stribeck, seed)), FrictionKind::stribeck);
    expect_found(fit, "Fc", 1.0, 0.01);
    expect_found(fit, "Fs", 1.5, 0.01);
    expect_found(fit, "vs", 1e-3, 0.05);
    expect_found(fit, "sigma2", 4.0, 0.1);
  }
}

TEST(Fit, FindsDahl) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const FrictionFit fit =
        fit_friction(noisy_record(plan_for(FrictionKind::dahl, seed)), FrictionKind::dahl);
    expect_found(fit, "Fc", 1.0, 0.01);
    expect_found(fit, "sigma0", 1e5, 0.03);
    expect_found(fit, "sigma2", 4.0, 0.1);
  }
}

TEST(Fit, FindsLugre) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const FrictionFit fit =
        fit_friction(noisy_record(plan_for(FrictionKind::lugre, seed)), FrictionKind::lugre);
    expect_found(fit, "Fc", 1.0, 0.01);
    expect_found(fit, "Fs", 1.5, 0.02);
    expect_found(fit, "vs", 1e-3, 0.05);
    expect_found(fit, "sigma0", 1e5, 0.03);
    expect_found(fit, "sigma1", 316.228, 0.1);
    expect_found(fit, "sigma2", 4.0, 0.1);
  }
}

TEST(Fit, FindsLugreOfAnotherSizeUnderANormalForce) {
  RecordPlan plan{.friction = {.kind = FrictionKind::lugre,
                               .coulomb = 0.3,
                               .static_level = 0.4,
                               .viscous_s_per_m = 0.5,
                               .stribeck_velocity_m_per_s = 0.01,
                               .stiffness_N_per_m = 2000.0,
                               .damping_s_per_m = 0.5},
                  .x_m = [](double t) { return 20.0 * widening_swings(t); },
                  .normal_force_N = 5.0,
                  .seed = 21};
  SCOPED_TRACE("seed 21");
  const FrictionFit fit = fit_friction(noisy_record(plan), FrictionKind::lugre);
  expect_found(fit, "Fc", 0.3, 0.02);
  expect_found(fit, "Fs", 0.4, 0.02);
  expect_found(fit, "vs", 0.01, 0.05);
  expect_found(fit, "sigma0", 2000.0, 0.03);
  expect_found(fit, "sigma2", 0.5, 0.02);
}

TEST(Fit, FindsTheExponentWhenAsked) {
  RecordPlan plan = plan_for(FrictionKind::stribeck, 31);
  plan.friction.stribeck_exponent = 1.0;
  SCOPED_TRACE("seed 31");
  const FrictionFit fit =
      fit_friction(noisy_record(plan), FrictionKind::stribeck, {.fits_exponent = true});
  expect_found(fit, "alpha", 1.0, 0.1);
  expect_found(fit, "vs", 1e-3, 0.1);
}

TEST(Fit, TheAicPrefersThePlantedModel) {
  const auto kinds = fitted_kinds();
  for (const FrictionKind planted : std::span(kinds).last(testing::part_of(kinds.size()))) {
    const FrictionRecord record = noisy_record(plan_for(planted, 41));
    std::vector<FrictionFit> fits;
    for (const FrictionKind kind : fitted_kinds()) {
      fits.push_back(fit_friction(record, kind));
    }
    EXPECT_EQ(fits[preferred(fits)].friction.kind, planted) << "seed 41";
  }
}

TEST(Fit, TheAicIsOfTheSumOfSquaresAndTheNumbersFitted) {
  const FrictionRecord record = noisy_record(plan_for(FrictionKind::coulomb_viscous, 42));
  const FrictionFit fit = fit_friction(record, FrictionKind::coulomb_viscous);
  double sum = 0.0;
  for (std::size_t k = 1; k < record.rows(); ++k) {
    sum += std::pow(fit.force_N[k] - record.force_N[k], 2);
  }
  const auto rows = static_cast<double>(record.rows() - 1);
  EXPECT_NEAR(fit.aic, rows * std::log(sum / rows) + 2.0 * 3.0, 1e-6 * rows);
}

TEST(Fit, SaysThatPreslidingIsMissingWhereTheMotionNeverReverses) {
  RecordPlan plan = plan_for(FrictionKind::lugre, 51);
  // The motion is in full slip from the first row on.
  plan.x_m = [](double t) { return 0.03 * t + 0.005 * std::sin(3.0 * t); };
  SCOPED_TRACE("seed 51");
  FrictionRecord record = noisy_record(plan);
  for (auto* column : {&record.t_s, &record.x_m, &record.force_N, &record.normal_force_N,
                       &record.step_s, &record.displacement_m}) {
    column->erase(column->begin(), column->begin() + 500);
  }
  const FrictionFit fit = fit_friction(record, FrictionKind::lugre);
  const FittedParameter& sigma0 = fit.parameter("sigma0");
  EXPECT_EQ(sigma0.knowledge, Knowledge::unknown);
  EXPECT_TRUE(contains(sigma0.why_unknown, "no presliding in the data"));
  EXPECT_EQ(fit.parameter("sigma1").knowledge, Knowledge::unknown);
  EXPECT_EQ(fit.parameter("vs").knowledge, Knowledge::unknown);
  EXPECT_TRUE(contains(fit.parameter("Fs").why_unknown, "no velocities near vs"));
  expect_found(fit, "Fc", 1.0, 0.02);
}

TEST(Fit, SaysThatPreslidingIsMissingWhereRowsAreTooFewAtReversals) {
  RecordPlan plan = plan_for(FrictionKind::dahl, 52);
  plan.x_m = [](double t) { return 0.05 * (1.0 - std::cos(3.0 * t)); };
  plan.rate_hz = 50.0;
  plan.seconds = 40.0;
  SCOPED_TRACE("seed 52");
  const FrictionRecord record = noisy_record(plan);
  const FrictionFit fit = fit_friction(record, FrictionKind::dahl);
  const FittedParameter& sigma0 = fit.parameter("sigma0");
  ASSERT_EQ(sigma0.knowledge, Knowledge::unknown);
  EXPECT_TRUE(contains(sigma0.why_unknown, "no presliding in the data"));
  EXPECT_TRUE(contains(sigma0.why_unknown, "it is at least"));
  const std::string toml = fit_toml("data.csv", fit, record, TomlUse::surface);
  EXPECT_TRUE(contains(toml, "# stiffness_N_per_m is left out, the data cannot tell it: no presl"));
  EXPECT_FALSE(contains(toml, "\nstiffness_N_per_m"));
}

TEST(Fit, SaysThatPreslidingAloneTellsNothingOfTheFallWithSpeed) {
  RecordPlan plan = plan_for(FrictionKind::lugre, 53);
  plan.x_m = [](double t) { return 3e-5 * std::sin(2.0 * t); };  // 60 um/s at most
  SCOPED_TRACE("seed 53");
  const FrictionFit fit = fit_friction(noisy_record(plan), FrictionKind::lugre);
  EXPECT_EQ(fit.parameter("vs").knowledge, Knowledge::unknown);
  EXPECT_TRUE(contains(fit.parameter("Fs").why_unknown, "no velocities near vs"));
  EXPECT_EQ(fit.parameter("sigma2").knowledge, Knowledge::unknown);
  expect_found(fit, "sigma0", 1e5, 0.03);
}

TEST(Fit, TomlHasTheKeysOfItsUse) {
  const FrictionRecord record = noisy_record(plan_for(FrictionKind::lugre, 61));
  const FrictionFit fit = fit_friction(record, FrictionKind::lugre);
  const std::string surface = fit_toml("data.csv", fit, record, TomlUse::surface);
  EXPECT_TRUE(contains(surface, "[object.friction]\nmodel = \"lugre\"\ndynamic = "));
  EXPECT_TRUE(contains(surface, "\ndamping_s_per_m = "));
  EXPECT_TRUE(contains(surface, "No normal force was given"));
  const std::string joint = fit_toml("data.csv", fit, record, TomlUse::joint);
  EXPECT_TRUE(contains(joint, "[joint.friction]\nmodel = \"lugre\"\ncoulomb_N = "));
  EXPECT_TRUE(contains(joint, "\ndamping_Ns_per_m = "));
}

}  // namespace
}  // namespace tactus::host
