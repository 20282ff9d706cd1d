// The published experiments on friction, for any model: presliding, frictional lag, break-away,
// stick-slip and hunting of the LuGre paper (Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE
// Transactions on Automatic Control 40(3), 1995, figures 2, 3, 4, 6 and 8), and the hysteresis loop
// (Dahl, 1968). `tactus friction --experiment` and the tests of the models run them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/friction/friction_run.h"

namespace tactus::host {

// A number of an experiment's set-up, or a list of numbers.
struct SetupValue {
  // The name with its unit, such as spring_N_per_m.
  std::string_view name;
  std::vector<double> value;
  // True if the user may give several numbers.
  bool is_list = false;
  // One line for --help.
  std::string_view meaning;
};

// The set-up of an experiment, with the published values at first.
class Setup {
 public:
  explicit Setup(std::vector<SetupValue> values) : values_(std::move(values)) {}

  // Takes over "spring_N_per_m=2", or "rates_N_per_s=1,5,20" for a list. Throws InputError if the
  // text does not have that form, the experiment has no such value, or a number is not above 0.
  void set(std::string_view assignment);

  // Returns a number by its name, which must exist.
  [[nodiscard]] double number(std::string_view name) const { return list(name).front(); }
  // Returns a list of numbers by its name, which must exist.
  [[nodiscard]] const std::vector<double>& list(std::string_view name) const;
  // All values in their order, for --help.
  [[nodiscard]] std::span<const SetupValue> values() const { return values_; }

 private:
  std::vector<SetupValue> values_;
};

// The settings of one experiment.
struct ExperimentRun {
  // Must be valid.
  rendering::FrictionParameters friction;
  double normal_force_N = 1.0;
  double mass_kg = 1.0;
  // Steps a second.
  double rate_hz = 1000.0;
  Setup setup;

  // Returns the largest force at which the mass stays at rest: Fs, or Fc for models without Fs.
  [[nodiscard]] double holding_force_N() const;
};

// The measured values: a row for each speed, rate, slip or loop. A value that does not exist is
// NaN.
struct FindingsTable {
  // The names with their units.
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

// The course of an experiment and what was measured in it.
struct ExperimentResult {
  FrictionTrack track;
  FindingsTable findings;
};

// An experiment in the table of experiments.cpp.
struct Experiment {
  // Its name for --experiment, such as stick-slip.
  std::string_view name;
  // Its name in headings.
  std::string_view title;
  // The procedure, on one line.
  std::string_view what;
  // Returns the set-up as published.
  Setup (*setup)();
  // Runs the experiment.
  ExperimentResult (*run)(const ExperimentRun& run);
};

// Returns all experiments.
std::span<const Experiment> experiments();

// Returns an experiment by its name, in which a hyphen and an underscore are the same. Throws
// InputError with the names if there is none.
const Experiment& experiment(std::string_view name);

// Returns a line for every experiment and every value of its set-up, for --help.
std::string experiment_help();

}  // namespace tactus::host
