#include "host_tools/cli/friction_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host_tools/cli/picture_option.h"
#include "host_tools/files/output_place.h"
#include "host_tools/friction/experiments.h"
#include "host_tools/friction/friction_figures.h"
#include "host_tools/friction/friction_run.h"
#include "host_tools/friction/parameter_names.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kFrictionExamples =
    "The output has the columns t_s,x_m,v_m_per_s,force_N,bristle_m, and further ones where an "
    "experiment has more to say.\n"
    "force_N points along the motion, as in the papers: a mass feels -force_N.\n"
    "  --motion: columns t_s,x_m; one tick and one line a row. The velocity is the difference to "
    "the row before.\n"
    "            With --rate-hz it is resampled by straight lines first.\n"
    "  --push:   columns t_s,force_N, straight lines between the rows, on a mass at rest; one line "
    "a tick.\n"
    "\n"
    "Examples:\n"
    "  tactus friction --model lugre --param sigma0=1e5 --param sigma1=316.228 --param Fc=1 "
    "--param Fs=1.5 --motion in.csv --output out.csv\n"
    "  tactus friction --model dahl --param Fc=0.3 --normal-force-N 2 --motion in.csv --output "
    "out.csv --figure out.png\n"
    "  tactus friction --model karnopp --push in.csv --mass-kg 0.5 --output out.csv\n"
    "  tactus friction --model lugre --experiment stick-slip --rate-hz 4000 --output out.csv "
    "--figure stick-slip.png\n"
    "  tactus friction --model lugre --experiment break-away --setup rates_N_per_s=1,5,20 --json";

constexpr double kDefaultRate_hz = 1000.0;

// The verb's options as the user gave them.
struct FrictionOptions {
  std::string model = "lugre";
  std::vector<std::string> parameters;
  std::string motion;
  std::string push;
  std::string experiment;
  std::vector<std::string> setup;
  double mass_kg = 1.0;
  std::optional<double> normal_force_N;
  std::optional<double> rate_hz;
  std::string output;
  std::string figure;
  bool json = false;
};

// Returns the published parameters with the user's changes. Throws InputError.
rendering::FrictionParameters parameters_from(const FrictionOptions& options) {
  return changed_parameters(options.model, options.parameters,
                            options.normal_force_N ? ForceScale::per_newton : ForceScale::newton);
}

// A value that does not exist is NaN in the table and null in JSON.
nlohmann::ordered_json json_of(const FindingsTable& findings) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::vector<double>& row : findings.rows) {
    nlohmann::ordered_json& object = rows.emplace_back(nlohmann::ordered_json::object());
    for (std::size_t i = 0; i < row.size(); ++i) {
      object[findings.columns[i]] =
          std::isfinite(row[i]) ? nlohmann::ordered_json(row[i]) : nlohmann::ordered_json();
    }
  }
  return rows;
}

void print_table(const FindingsTable& findings) {
  const auto width = [](const std::string& column) {
    return std::max<std::size_t>(column.size(), 12);
  };
  for (const std::string& column : findings.columns) {
    fmt::print("{:>{}}  ", column, width(column));
  }
  fmt::print("\n");
  for (const std::vector<double>& row : findings.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string text = std::isfinite(row[i]) ? fmt::format("{:.6g}", row[i]) : "-";
      fmt::print("{:>{}}  ", text, width(findings.columns[i]));
    }
    fmt::print("\n");
  }
}

void report(const FrictionOptions& options, const FrictionTrack& track,
            const FindingsTable& findings) {
  if (options.json) {
    nlohmann::ordered_json json{{"model", options.model}};
    if (!options.experiment.empty()) {
      json["experiment"] = options.experiment;
    }
    json["rows"] = track.samples.size();
    if (!findings.columns.empty()) {
      json["findings"] = json_of(findings);
    }
    fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  if (!findings.columns.empty()) {
    print_table(findings);
  }
  if (!options.output.empty()) {
    fmt::print("{}: {} rows\n", options.output, track.samples.size());
  }
  if (!options.figure.empty()) {
    fmt::print("{}\n", options.figure);
  }
}

std::string title(const rendering::FrictionParameters& parameters, const std::string& file) {
  return fmt::format("{}, {} model", std::filesystem::path(file).filename().string(),
                     model_of(parameters.kind).title);
}

FrictionTrack motion_track(const FrictionOptions& options,
                           const rendering::FrictionParameters& friction) {
  TimeSeries motion = read_time_series(options.motion, "x_m");
  if (options.rate_hz) {
    motion = resampled(motion, *options.rate_hz);
  }
  FrictionTrack track = run_motion(
      {.friction = friction, .normal_force_N = options.normal_force_N.value_or(1.0)}, motion);
  if (!options.figure.empty()) {
    draw_motion(title(friction, options.motion), track, options.figure);
  }
  return track;
}

FrictionTrack push_track(const FrictionOptions& options,
                         const rendering::FrictionParameters& friction) {
  FrictionTrack track = run_push({.friction = friction,
                                  .normal_force_N = options.normal_force_N.value_or(1.0),
                                  .mass_kg = options.mass_kg,
                                  .rate_hz = options.rate_hz.value_or(kDefaultRate_hz)},
                                 read_time_series(options.push, "force_N"));
  if (!options.figure.empty()) {
    draw_push(title(friction, options.push), track, options.figure);
  }
  return track;
}

ExperimentResult experiment_result(const FrictionOptions& options,
                                   const rendering::FrictionParameters& friction) {
  const Experiment& known = experiment(options.experiment);
  ExperimentRun run{.friction = friction,
                    .normal_force_N = options.normal_force_N.value_or(1.0),
                    .mass_kg = options.mass_kg,
                    .rate_hz = options.rate_hz.value_or(kDefaultRate_hz),
                    .setup = known.setup()};
  for (const std::string& assignment : options.setup) {
    run.setup.set(assignment);
  }
  ExperimentResult result = known.run(run);
  if (!options.figure.empty()) {
    draw_experiment(known, run, result.track, options.figure);
  }
  return result;
}

void run_friction(const FrictionOptions& options) {
  const int tasks = static_cast<int>(!options.motion.empty()) +
                    static_cast<int>(!options.push.empty()) +
                    static_cast<int>(!options.experiment.empty());
  if (tasks != 1) {
    throw InputError("say what to do: one of --motion, --push and --experiment");
  }
  if (options.output.empty() && options.figure.empty() && options.experiment.empty()) {
    throw InputError("say where to put the result: --output, --figure or both");
  }
  if (!options.setup.empty() && options.experiment.empty()) {
    throw InputError("--setup is for an --experiment");
  }
  keep_inputs_safe({options.output, options.figure}, {options.motion, options.push});
  const rendering::FrictionParameters friction = parameters_from(options);
  ExperimentResult result;
  if (!options.motion.empty()) {
    result.track = motion_track(options, friction);
  } else if (!options.push.empty()) {
    result.track = push_track(options, friction);
  } else {
    result = experiment_result(options, friction);
  }
  if (!options.output.empty()) {
    write_track(options.output, result.track);
  }
  report(options, result.track, result.findings);
}

}  // namespace

void add_friction_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "friction", "Run a friction model on a motion, on a pushed mass, or in an experiment");
  const auto options = std::make_shared<FrictionOptions>();
  verb->add_option("--model", options->model, model_help())->capture_default_str();
  verb->add_option("--param", options->parameters, "A parameter, NAME=VALUE; repeat for more")
      ->take_all();
  verb->add_option("--motion", options->motion, "Displacement over time (CSV: t_s,x_m)");
  verb->add_option("--push", options->push, "Force on a mass over time (CSV: t_s,force_N)");
  verb->add_option("--experiment", options->experiment,
                   "presliding, lag, break-away, stick-slip, hunting or hysteresis");
  verb->add_option("--setup", options->setup,
                   "A value of the experiment's set-up, NAME=VALUE; repeat for more")
      ->take_all();
  verb->add_option("--mass-kg", options->mass_kg, "The mass")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--normal-force-N", options->normal_force_N,
                   "What presses on the surface; Fc, Fs, sigma1 and sigma2 are then per newton")
      ->check(CLI::PositiveNumber);
  verb->add_option("--rate-hz", options->rate_hz,
                   "Ticks a second; default 1000, of a motion one a row")
      ->check(CLI::Range(kLeastFrictionRate_hz, kMostFrictionRate_hz));
  verb->add_option("-o,--output", options->output, "Write the result to this CSV file");
  verb->add_option("--figure", options->figure, "Draw it into this .png, .svg or .pdf file")
      ->check(picture_complaint);
  verb->add_flag("--json", options->json, "Print what was found as one JSON object");
  verb->footer(parameter_help() + "\n" + experiment_help() + "\n" + kFrictionExamples);
  verb->callback([options] { run_friction(*options); });
}

}  // namespace tactus::host
