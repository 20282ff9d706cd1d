#include "host_tools/friction/driven_experiments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace tactus::host {
namespace {

using rendering::FrictionMemory;
using rendering::update_friction;

constexpr double kTurn = 2.0 * std::numbers::pi;
// A finding that does not exist.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::size_t ticks(double duration_s, double rate_hz) {
  return static_cast<std::size_t>(std::lround(duration_s * rate_hz));
}

// Returns the force where the velocity first passes `v`, rising or falling, by linear interpolation
// between two samples; kNone if it never does.
double force_at(std::span<const FrictionSample> samples, double v, bool rising) {
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const FrictionSample& a = samples[k - 1];
    const FrictionSample& b = samples[k];
    const bool passes =
        rising ? a.v_m_per_s < v && b.v_m_per_s >= v : a.v_m_per_s > v && b.v_m_per_s <= v;
    if (passes) {
      return std::lerp(a.force_N, b.force_N, (v - a.v_m_per_s) / (b.v_m_per_s - a.v_m_per_s));
    }
  }
  return kNone;
}

// Returns the area of the closed loop of force over velocity, W, by trapezoids.
double area_over_velocity(std::span<const FrictionSample> samples) {
  double area = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const FrictionSample& a = samples[k];
    const FrictionSample& b = samples[(k + 1) % samples.size()];
    area += 0.5 * (a.force_N + b.force_N) * (b.v_m_per_s - a.v_m_per_s);
  }
  return std::fabs(area);
}

}  // namespace

Setup lag_setup() {
  return Setup({{"omegas_rad_per_s", {1.0, 10.0, 25.0}, true, "of the swinging velocity"},
                {"mean_m_per_s", {1.5e-3}, false, "mean velocity"},
                {"swing_m_per_s", {1e-3}, false, "amplitude of the velocity, below the mean"}});
}

ExperimentResult run_lag(const ExperimentRun& run) {
  // Rising and falling are compared at this share of the swing from the mean.
  constexpr double kFromMean = 0.5;
  const double mean = run.setup.number("mean_m_per_s");
  const double swing = run.setup.number("swing_m_per_s");
  const double step_s = 1.0 / run.rate_hz;
  ExperimentResult result;
  result.findings.columns = {"omega_rad_per_s",        "force_max_N",
                             "speed_at_max_m_per_s",   "falling_at_low_speed_N",
                             "rising_at_low_speed_N",  "falling_at_mean_N",
                             "rising_at_mean_N",       "falling_at_high_speed_N",
                             "rising_at_high_speed_N", "loop_area_N_m_per_s"};
  NamedColumn column{.name = "omega_rad_per_s", .values = {}};
  std::vector<FrictionSample>& samples = result.track.samples;
  for (const double omega : run.setup.list("omegas_rad_per_s")) {
    // The place is the integral of the velocity mean + swing cos(omega t). The first period lets
    // the bristle settle; the second is kept.
    const auto way = [&](double t) { return mean * t + swing * std::sin(omega * t) / omega; };
    const std::size_t period = std::max<std::size_t>(ticks(kTurn / omega, run.rate_hz), 1);
    const std::size_t begin = samples.size();
    FrictionMemory<double> memory;
    for (std::size_t k = 0; k < 2 * period; ++k) {
      const double t = static_cast<double>(k) * step_s;
      const double displacement = way(t + step_s) - way(t);
      const auto friction =
          update_friction(run.friction, memory, displacement, run.normal_force_N, step_s);
      if (k >= period) {
        samples.push_back({.t_s = t + 0.5 * step_s,
                           .x_m = 0.5 * (way(t) + way(t + step_s)),
                           .v_m_per_s = displacement / step_s,
                           .force_N = friction.mean_force_N,
                           .bristle_m = friction.bristle_m});
        column.values.push_back(omega);
      }
    }
    const std::span<const FrictionSample> loop = std::span(samples).subspan(begin);
    const auto top = std::ranges::max_element(loop, {}, &FrictionSample::force_N);
    const auto pair = [&](std::vector<double>& row, double v) {
      row.push_back(force_at(loop, v, false));
      row.push_back(force_at(loop, v, true));
    };
    std::vector<double> row{omega, top->force_N, top->v_m_per_s};
    pair(row, mean - kFromMean * swing);
    pair(row, mean);
    pair(row, mean + kFromMean * swing);
    row.push_back(area_over_velocity(loop));
    result.findings.rows.push_back(std::move(row));
  }
  result.track.more.push_back(std::move(column));
  return result;
}

Setup hysteresis_setup() {
  return Setup({{"amplitudes_m", {5e-6, 1e-5, 2e-5, 4e-5}, true, "of the motion"},
                {"frequency_hz", {0.1}, false, "of the motion"},
                {"cycles", {20.0}, false, "before the one that is kept"}});
}

ExperimentResult run_hysteresis(const ExperimentRun& run) {
  const double frequency_hz = run.setup.number("frequency_hz");
  const std::size_t period = std::max<std::size_t>(ticks(1.0 / frequency_hz, run.rate_hz), 4);
  const std::size_t before = period * ticks(run.setup.number("cycles"), 1.0);
  const double step_s = 1.0 / run.rate_hz;
  ExperimentResult result;
  result.findings.columns = {"amplitude_m", "turning_force_N", "loop_area_J"};
  NamedColumn column{.name = "amplitude_m", .values = {}};
  for (const double amplitude : run.setup.list("amplitudes_m")) {
    // The phase is reduced to one period first, so that all cycles have the same bits.
    const auto place = [&](std::size_t k) {
      return amplitude *
             std::sin(kTurn * static_cast<double>(k % period) / static_cast<double>(period));
    };
    FrictionMemory<double> memory;
    double work_J = 0.0;
    double turning_N = 0.0;
    for (std::size_t k = 1; k <= before + period; ++k) {
      const double displacement = place(k) - place(k - 1);
      const auto friction =
          update_friction(run.friction, memory, displacement, run.normal_force_N, step_s);
      if (k >= before) {
        result.track.samples.push_back({.t_s = static_cast<double>(k) / run.rate_hz,
                                        .x_m = place(k),
                                        .v_m_per_s = displacement / step_s,
                                        .force_N = friction.force_N,
                                        .bristle_m = friction.bristle_m});
        column.values.push_back(amplitude);
      }
      if (k > before) {
        work_J += friction.mean_force_N * displacement;
        turning_N = std::max(turning_N, friction.force_N);
      }
    }
    result.findings.rows.push_back({amplitude, turning_N, work_J});
  }
  result.track.more.push_back(std::move(column));
  return result;
}

}  // namespace tactus::host
