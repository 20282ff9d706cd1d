// The published experiments on friction, to be run with any model: presliding, frictional lag,
// break-away, stick-slip and hunting of the LuGre paper (Canudas de Wit, Olsson, Astrom,
// Lischinsky, IEEE Transactions on Automatic Control 40(3), 1995, figures 2, 3, 4, 6 and 8), and
// the hysteresis loop (Dahl, 1968).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/friction/friction_run.h"

namespace tactus::host {

// A number, or a list of them, of an experiment's set-up.
struct SetupValue {
  std::string_view name;  // with its unit
  std::vector<double> value;
  bool is_list = false;
  std::string_view meaning;
};

class Setup {
 public:
  explicit Setup(std::vector<SetupValue> values) : values_(std::move(values)) {}

  // Takes over "spring_N_per_m=2", of a list "rates_N_per_s=1,5,20". Throws InputError: not of that
  // form, no such name (with the list of those there are), not numbers above 0.
  void set(std::string_view assignment);

  [[nodiscard]] double number(std::string_view name) const { return list(name).front(); }
  [[nodiscard]] const std::vector<double>& list(std::string_view name) const;
  [[nodiscard]] std::span<const SetupValue> values() const { return values_; }

 private:
  std::vector<SetupValue> values_;
};

struct ExperimentRun {
  rendering::FrictionParameters friction;  // valid
  double normal_force_N = 1.0;
  double mass_kg = 1.0;
  double rate_hz = 1000.0;
  Setup setup;

  // Returns the largest force at which the mass stays at rest, N: Fs, or Fc for models without Fs.
  [[nodiscard]] double holding_force_N() const;
};

// The measurements: a row for each speed, rate, slip or loop. A value that does not exist is NaN.
struct FindingsTable {
  std::vector<std::string> columns;  // with units
  std::vector<std::vector<double>> rows;
};

struct ExperimentResult {
  FrictionTrack track;
  FindingsTable findings;
};

struct Experiment {
  std::string_view name;
  std::string_view title;
  std::string_view what;  // one line: what is done, and what is found
  Setup (*setup)();       // as published
  ExperimentResult (*run)(const ExperimentRun& run);
};

std::span<const Experiment> experiments();

// A hyphen counts as an underscore. Throws InputError, listing the names, if there is none.
const Experiment& experiment(std::string_view name);

// A line for every experiment and every value of its set-up: for --help.
std::string experiment_help();

}  // namespace tactus::host
