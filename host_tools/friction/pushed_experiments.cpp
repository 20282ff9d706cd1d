#include "host_tools/friction/pushed_experiments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "host_tools/friction/sliding_mass.h"

namespace tactus::host {
namespace {

// A finding that does not exist.
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

std::size_t tick_count(double duration_s, double rate_hz) {
  return static_cast<std::size_t>(std::lround(duration_s * rate_hz));
}

// Returns the mass of the experiment, at rest at 0.
SlidingMass mass_of(const ExperimentRun& run, double spring_N_per_m) {
  return SlidingMass({.friction = run.friction,
                      .mass_kg = run.mass_kg,
                      .spring_N_per_m = spring_N_per_m,
                      .normal_force_N = run.normal_force_N});
}

// Returns the row of a state.
FrictionSample sample_of(const SlidingMassState& state, double t_s) {
  return {.t_s = t_s,
          .x_m = state.x_m,
          .v_m_per_s = state.v_m_per_s,
          .force_N = state.friction.force_N,
          .bristle_m = state.friction.bristle_m};
}

// Returns the force over time: up, hold, down to the opposite, hold, up again, hold.
TimeSeries presliding_push(const ExperimentRun& run) {
  const double peak_N = run.setup.number("peak_share") * run.holding_force_N();
  const double ramp_s = run.setup.number("ramp_s");
  const double hold_s = run.setup.number("hold_s");
  TimeSeries push{.t_s = {0.0}, .value = {0.0}};
  const auto go = [&push](double duration_s, double value) {
    push.t_s.push_back(push.t_s.back() + duration_s);
    push.value.push_back(value);
  };
  go(ramp_s, peak_N);
  go(hold_s, peak_N);
  go(2.0 * ramp_s, -peak_N);
  go(hold_s, -peak_N);
  go(2.0 * ramp_s, peak_N);
  go(hold_s, peak_N);
  return push;
}

}  // namespace

Setup presliding_setup() {
  return Setup({{"peak_share", {0.95}, false, "of Fs (Fc without Fs): the largest force"},
                {"ramp_s", {10.0}, false, "from zero to the largest force"},
                {"hold_s", {5.0}, false, "how long the largest force is held"}});
}

ExperimentResult run_presliding(const ExperimentRun& run) {
  const TimeSeries push = presliding_push(run);
  ExperimentResult result;
  result.track = run_push({.friction = run.friction,
                           .normal_force_N = run.normal_force_N,
                           .mass_kg = run.mass_kg,
                           .rate_hz = run.rate_hz},
                          push);
  const std::vector<FrictionSample>& samples = result.track.samples;
  const auto at = [&](std::size_t corner) {
    return std::min(tick_count(push.t_s[corner], run.rate_hz), samples.size() - 1);
  };
  // The area of force over place from the first peak on, by trapezoids: what the loop dissipates.
  double loop_J = 0.0;
  for (std::size_t k = at(2) + 1; k < samples.size(); ++k) {
    loop_J +=
        0.5 * (samples[k].force_N + samples[k - 1].force_N) * (samples[k].x_m - samples[k - 1].x_m);
  }
  result.findings.columns = {"x_after_ramp_m",      "x_after_hold_m",    "x_after_ramp_down_m",
                             "x_after_hold_down_m", "x_after_ramp_up_m", "x_at_end_m",
                             "loop_area_J"};
  result.findings.rows = {{samples[at(1)].x_m, samples[at(2)].x_m, samples[at(3)].x_m,
                           samples[at(4)].x_m, samples[at(5)].x_m, samples.back().x_m, loop_J}};
  return result;
}

Setup break_away_setup() {
  return Setup(
      {{"rates_N_per_s", {1, 2, 5, 10, 20, 30, 40, 50}, true, "at which the force grows"},
       {"sliding_m_per_s", {0.01}, false, "by when the mass has broken away in any case"}});
}

ExperimentResult run_break_away(const ExperimentRun& run) {
  const double step_s = 1.0 / run.rate_hz;
  const double sliding = run.setup.number("sliding_m_per_s");
  ExperimentResult result;
  result.findings.columns = {"rate_N_per_s", "break_away_N", "t_s", "is_maximum"};
  NamedColumn rates{.name = "rate_N_per_s", .values = {}};
  NamedColumn maxima{.name = "is_maximum", .values = {}};
  for (const double rate : run.setup.list("rates_N_per_s")) {
    SlidingMass mass = mass_of(run, 0.0);
    // The mean force of a tick belongs to its middle.
    FrictionSample best;
    bool is_maximum = false;
    // The force grows until friction has its first maximum or, in a model without one, the mass
    // slides.
    while (!is_maximum && mass.state().v_m_per_s < sliding) {
      const double middle_s = mass.state().time_s + 0.5 * step_s;
      const SlidingMassState& now = mass.step({.push_N = rate * middle_s}, step_s);
      is_maximum = now.friction.mean_force_N < best.force_N;
      if (!is_maximum) {
        best = sample_of(now, middle_s);
        best.force_N = now.friction.mean_force_N;
      }
    }
    result.track.samples.push_back(best);
    rates.values.push_back(rate);
    maxima.values.push_back(is_maximum ? 1.0 : 0.0);
    result.findings.rows.push_back({rate, best.force_N, best.t_s, maxima.values.back()});
  }
  result.track.more = {std::move(rates), std::move(maxima)};
  return result;
}

namespace {

// The passage of a threshold, by linear interpolation between two ticks.
struct Passage {
  double t_s = 0.0;
  double x_m = 0.0;
};

// Returns where the speed passes `v_m_per_s` between the samples a and b.
Passage passage(const FrictionSample& a, const FrictionSample& b, double v_m_per_s) {
  const double share = (v_m_per_s - a.v_m_per_s) / (b.v_m_per_s - a.v_m_per_s);
  return {.t_s = std::lerp(a.t_s, b.t_s, share), .x_m = std::lerp(a.x_m, b.x_m, share)};
}

// Returns a row for each slip; the first has no period, since nothing came before.
FindingsTable slips_of(const std::vector<FrictionSample>& samples, double threshold) {
  FindingsTable table;
  table.columns = {"start_s",         "period_s",           "duration_s",
                   "slip_distance_m", "peak_speed_m_per_s", "peak_friction_N"};
  std::optional<Passage> start;
  double last_start_s = kNoValue;
  double fastest = 0.0;
  double strongest_N = 0.0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const FrictionSample& a = samples[k - 1];
    const FrictionSample& b = samples[k];
    strongest_N = std::max(strongest_N, b.force_N);
    fastest = std::max(fastest, b.v_m_per_s);
    const bool was_fast = a.v_m_per_s >= threshold;
    const bool is_fast = b.v_m_per_s >= threshold;
    if (!was_fast && is_fast) {
      start = passage(a, b, threshold);
    } else if (was_fast && !is_fast && start) {
      const Passage end = passage(a, b, threshold);
      table.rows.push_back({start->t_s, start->t_s - last_start_s, end.t_s - start->t_s,
                            end.x_m - start->x_m, fastest, strongest_N});
      last_start_s = start->t_s;
      fastest = 0.0;
      strongest_N = 0.0;
    }
  }
  return table;
}

}  // namespace

Setup stick_slip_setup() {
  return Setup({{"spring_N_per_m", {2.0}, false, "stiffness of the spring"},
                {"speed_m_per_s", {0.1}, false, "of the spring's other end"},
                {"seconds", {40.0}, false, "how long it is pulled"},
                {"slipping_m_per_s", {0.01}, false, "the mass slips when it is faster"}});
}

ExperimentResult run_stick_slip(const ExperimentRun& run) {
  const double step_s = 1.0 / run.rate_hz;
  const double spring = run.setup.number("spring_N_per_m");
  const double speed = run.setup.number("speed_m_per_s");
  SlidingMass mass = mass_of(run, spring);
  ExperimentResult result;
  NamedColumn end_m{.name = "spring_end_m", .values = {0.0}};
  NamedColumn spring_N{.name = "spring_N", .values = {0.0}};
  result.track.samples.push_back({});
  const std::size_t count = tick_count(run.setup.number("seconds"), run.rate_hz);
  for (std::size_t k = 1; k <= count; ++k) {
    const double t_s = static_cast<double>(k) / run.rate_hz;
    const SlidingMassState& now = mass.step({.spring_end_m = speed * (t_s - 0.5 * step_s)}, step_s);
    result.track.samples.push_back(sample_of(now, t_s));
    end_m.values.push_back(speed * t_s);
    spring_N.values.push_back(spring * (speed * t_s - now.x_m));
  }
  result.findings = slips_of(result.track.samples, run.setup.number("slipping_m_per_s"));
  result.track.more = {std::move(end_m), std::move(spring_N)};
  return result;
}

namespace {

// Returns period and amplitude from the times at which the mass passes the target upwards, in the
// second half.
FindingsTable cycles_of(const std::vector<FrictionSample>& samples, double target_m) {
  std::vector<double> passages_s;
  double highest_m = 0.0;
  double lowest_m = 0.0;
  for (std::size_t k = samples.size() / 2; k < samples.size(); ++k) {
    const double before = samples[k - 1].x_m - target_m;
    const double now = samples[k].x_m - target_m;
    if (before < 0.0 && now >= 0.0) {
      passages_s.push_back(std::lerp(samples[k - 1].t_s, samples[k].t_s, before / (before - now)));
    }
    highest_m = std::max(highest_m, now);
    lowest_m = std::min(lowest_m, now);
  }
  const double period_s = passages_s.size() < 2 ? kNoValue
                                                : (passages_s.back() - passages_s.front()) /
                                                      static_cast<double>(passages_s.size() - 1);
  return {.columns = {"period_s", "highest_above_target_m", "lowest_below_target_m"},
          .rows = {{period_s, highest_m, -lowest_m}}};
}

}  // namespace

Setup hunting_setup() {
  return Setup({{"target_m", {1.0}, false, "where the mass is to go, from 0"},
                {"Kp_N_per_m", {3.0}, false, "proportional gain"},
                {"Ki_N_per_m_s", {4.0}, false, "integral gain"},
                {"Kv_Ns_per_m", {6.0}, false, "gain of the velocity"},
                {"seconds", {100.0}, false, "how long"}});
}

ExperimentResult run_hunting(const ExperimentRun& run) {
  const double step_s = 1.0 / run.rate_hz;
  const double target_m = run.setup.number("target_m");
  const double kp = run.setup.number("Kp_N_per_m");
  const double ki = run.setup.number("Ki_N_per_m_s");
  const double kv = run.setup.number("Kv_Ns_per_m");
  SlidingMass mass = mass_of(run, 0.0);
  ExperimentResult result;
  NamedColumn target{.name = "target_m", .values = {target_m}};
  NamedColumn control{.name = "control_N", .values = {0.0}};
  result.track.samples.push_back({});
  double integral_m_s = 0.0;
  const std::size_t count = tick_count(run.setup.number("seconds"), run.rate_hz);
  for (std::size_t k = 1; k <= count; ++k) {
    // The PID controller of the paper, sampled at the start of a tick: u = -Kv v - Kp e - Ki
    // integral(e).
    const double error_m = mass.state().x_m - target_m;
    integral_m_s += error_m * step_s;
    const double control_N = -kp * error_m - ki * integral_m_s - kv * mass.state().v_m_per_s;
    const SlidingMassState& now = mass.step({.push_N = control_N}, step_s);
    result.track.samples.push_back(sample_of(now, static_cast<double>(k) / run.rate_hz));
    target.values.push_back(target_m);
    control.values.push_back(control_N);
  }
  result.findings = cycles_of(result.track.samples, target_m);
  result.track.more = {std::move(target), std::move(control)};
  return result;
}

}  // namespace tactus::host
