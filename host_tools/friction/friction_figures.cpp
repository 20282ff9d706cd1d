#include "host_tools/friction/friction_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host_tools/friction/parameter_names.h"
#include "host_tools/plot/panels.h"

namespace tactus::host {
namespace {

// A unit for the axis, chosen so that the largest length is a handy number.
struct LengthUnit {
  std::string_view name;
  double per_metre;
};

LengthUnit unit_for(double largest_m) {
  constexpr LengthUnit kMicrometres{"µm", 1e6};
  constexpr LengthUnit kMillimetres{"mm", 1e3};
  constexpr LengthUnit kMetres{"m", 1.0};
  return largest_m < 0.5e-3 ? kMicrometres : largest_m < 0.5 ? kMillimetres : kMetres;
}

// Returns the largest absolute value of a member.
double largest(const std::vector<FrictionSample>& samples, double FrictionSample::* member) {
  double result = 0.0;
  for (const FrictionSample& sample : samples) {
    result = std::max(result, std::fabs(sample.*member));
  }
  return result;
}

// Returns a member of all samples, times a factor.
std::vector<double> values(const std::vector<FrictionSample>& samples,
                           double FrictionSample::* member, double factor = 1.0) {
  std::vector<double> result;
  result.reserve(samples.size());
  for (const FrictionSample& sample : samples) {
    result.push_back(factor * sample.*member);
  }
  return result;
}

std::vector<double> scaled(std::vector<double> numbers, double factor) {
  for (double& number : numbers) {
    number *= factor;
  }
  return numbers;
}

// Returns a curve over the samples' time.
Curve over_time(const FrictionTrack& track, std::string name, std::vector<double> y,
                CurveStyle style = CurveStyle::line) {
  return {.name = std::move(name),
          .x = values(track.samples, &FrictionSample::t_s),
          .y = std::move(y),
          .style = style};
}

// Returns the panel of friction force over displacement, on which hysteresis shows as an area.
Panel force_over_displacement(const FrictionTrack& track) {
  const LengthUnit unit = unit_for(largest(track.samples, &FrictionSample::x_m));
  return {.x_label = fmt::format("displacement ({})", unit.name),
          .y_label = "friction force (N)",
          .curves = {{.x = values(track.samples, &FrictionSample::x_m, unit.per_metre),
                      .y = values(track.samples, &FrictionSample::force_N)}}};
}

// Returns the samples in groups of equal values of a further column.
std::vector<std::pair<double, FrictionTrack>> parts(const FrictionTrack& track,
                                                    std::string_view column) {
  std::vector<std::pair<double, FrictionTrack>> result;
  const std::vector<double>& keys = track.column(column)->values;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (result.empty() || result.back().first != keys[k]) {
      result.emplace_back(keys[k], FrictionTrack{});
    }
    result.back().second.samples.push_back(track.samples[k]);
  }
  return result;
}

std::vector<Panel> hysteresis_panels(const ExperimentRun& /*run*/, const FrictionTrack& track) {
  const LengthUnit unit = unit_for(largest(track.samples, &FrictionSample::x_m));
  Panel panel = force_over_displacement(track);
  panel.curves.clear();
  for (const auto& [amplitude_m, part] : parts(track, "amplitude_m")) {
    panel.curves.push_back(
        {.name = fmt::format("±{:.4g} {}", unit.per_metre * amplitude_m, unit.name),
         .x = values(part.samples, &FrictionSample::x_m, unit.per_metre),
         .y = values(part.samples, &FrictionSample::force_N)});
  }
  return {panel};
}

std::vector<Panel> presliding_panels(const ExperimentRun& /*run*/, const FrictionTrack& track) {
  return {force_over_displacement(track)};
}

// Each frequency draws a closed loop around the steady curve; the wider, the more the friction
// lags.
std::vector<Panel> lag_panels(const ExperimentRun& run, const FrictionTrack& track) {
  constexpr double kMillimetres = 1e3;
  constexpr int kSteadyPoints = 300;
  Panel panel{.x_label = "velocity (mm/s)", .y_label = "friction force (N)", .curves = {}};
  double slowest = track.samples.front().v_m_per_s;
  double fastest = slowest;
  for (const auto& [omega, part] : parts(track, "omega_rad_per_s")) {
    Curve curve{.name = fmt::format("{:g} rad/s", omega),
                .x = values(part.samples, &FrictionSample::v_m_per_s, kMillimetres),
                .y = values(part.samples, &FrictionSample::force_N)};
    curve.x.push_back(curve.x.front());
    curve.y.push_back(curve.y.front());
    panel.curves.push_back(std::move(curve));
    for (const FrictionSample& sample : part.samples) {
      slowest = std::min(slowest, sample.v_m_per_s);
      fastest = std::max(fastest, sample.v_m_per_s);
    }
  }
  Curve steady{.name = "steady", .x = {}, .y = {}, .style = CurveStyle::dashes};
  for (int i = 0; i <= kSteadyPoints; ++i) {
    const double v = std::lerp(slowest, fastest, static_cast<double>(i) / kSteadyPoints);
    steady.x.push_back(kMillimetres * v);
    steady.y.push_back(run.normal_force_N * (rendering::steady_level(run.friction, v) +
                                             run.friction.viscous_s_per_m * v));
  }
  panel.curves.push_back(std::move(steady));
  return {panel};
}

// The break-away force falls with the rate of the push, from Fs toward Fc.
std::vector<Panel> break_away_panels(const ExperimentRun& run, const FrictionTrack& track) {
  const std::vector<double>& rates = track.column("rate_N_per_s")->values;
  const auto [least, most] = std::ranges::minmax(rates);
  Panel panel{.x_label = "rate of the force (N/s)", .y_label = "break-away force (N)"};
  panel.curves.push_back({.name = "break-away",
                          .x = rates,
                          .y = values(track.samples, &FrictionSample::force_N),
                          .style = CurveStyle::line_with_points});
  const auto level = [&](const char* name, double force_N) {
    panel.curves.push_back(
        {.name = name, .x = {least, most}, .y = {force_N, force_N}, .style = CurveStyle::dashes});
  };
  if (rendering::has_static_level(run.friction.kind)) {
    level("Fs", run.friction.static_level * run.normal_force_N);
  }
  level("Fc", run.friction.coulomb * run.normal_force_N);
  return {panel};
}

// Returns position and force of a driven mass over time. `goal` and `drive` are names of columns:
// where the mass should go, if there is such a column, and what pulls at it.
std::vector<Panel> mass_panels(const FrictionTrack& track, std::string_view goal,
                               const std::string& goal_name, std::string_view drive,
                               const std::string& drive_name) {
  double reach_m = largest(track.samples, &FrictionSample::x_m);
  const NamedColumn* goal_column = track.column(goal);
  if (goal_column != nullptr) {
    reach_m = std::max(reach_m, *std::ranges::max_element(goal_column->values));
  }
  const LengthUnit unit = unit_for(reach_m);
  Panel position{.x_label = {}, .y_label = fmt::format("position ({})", unit.name), .curves = {}};
  position.curves.push_back(
      over_time(track, "mass", values(track.samples, &FrictionSample::x_m, unit.per_metre)));
  if (goal_column != nullptr) {
    position.curves.push_back(over_time(
        track, goal_name, scaled(goal_column->values, unit.per_metre), CurveStyle::dashes));
  }
  Panel force{.x_label = "time (s)", .y_label = "force (N)", .curves = {}};
  force.curves.push_back(
      over_time(track, "friction", values(track.samples, &FrictionSample::force_N)));
  force.curves.push_back(
      over_time(track, drive_name, track.column(drive)->values, CurveStyle::dashes));
  return {position, force};
}

std::vector<Panel> stick_slip_panels(const ExperimentRun& /*run*/, const FrictionTrack& track) {
  return mass_panels(track, "spring_end_m", "end of the spring", "spring_N", "spring");
}

std::vector<Panel> hunting_panels(const ExperimentRun& /*run*/, const FrictionTrack& track) {
  return mass_panels(track, "target_m", "target", "control_N", "controller");
}

// Which panels show which experiment.
struct ExperimentPanels {
  std::string_view name;
  std::vector<Panel> (*panels)(const ExperimentRun& run, const FrictionTrack& track);
};

constexpr std::array kPanelsOfExperiments{ExperimentPanels{"presliding", presliding_panels},
                                          ExperimentPanels{"lag", lag_panels},
                                          ExperimentPanels{"break-away", break_away_panels},
                                          ExperimentPanels{"stick-slip", stick_slip_panels},
                                          ExperimentPanels{"hunting", hunting_panels},
                                          ExperimentPanels{"hysteresis", hysteresis_panels}};

}  // namespace

void draw_experiment(const Experiment& experiment, const ExperimentRun& run,
                     const FrictionTrack& track, const std::filesystem::path& picture) {
  const auto found =
      std::ranges::find(kPanelsOfExperiments, experiment.name, &ExperimentPanels::name);
  draw_panels(fmt::format("{}, {} model, {:g} Hz", experiment.title,
                          model_of(run.friction.kind).title, run.rate_hz),
              found->panels(run, track), picture);
}

void draw_motion(const std::string& title, const FrictionTrack& track,
                 const std::filesystem::path& picture) {
  const std::array panels{
      force_over_displacement(track),
      Panel{.x_label = "time (s)",
            .y_label = "friction force (N)",
            .curves = {over_time(track, "", values(track.samples, &FrictionSample::force_N))}}};
  draw_panels(title, panels, picture);
}

void draw_push(const std::string& title, const FrictionTrack& track,
               const std::filesystem::path& picture) {
  draw_panels(title, mass_panels(track, "", "", "push_N", "push"), picture);
}

}  // namespace tactus::host
