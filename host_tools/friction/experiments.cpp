#include "host_tools/friction/experiments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "host_tools/friction/driven_experiments.h"
#include "host_tools/friction/parameter_names.h"
#include "host_tools/friction/pushed_experiments.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array kExperiments{
    Experiment{"presliding", "Presliding",
               "a force ramps to just below break-away, back to the opposite and up again, slowly",
               presliding_setup, run_presliding},
    Experiment{"lag", "Frictional lag",
               "the velocity swings about a mean, one way; friction lags behind it", lag_setup,
               run_lag},
    Experiment{"break-away", "Break-away",
               "a force ramps up at several rates until the mass slides", break_away_setup,
               run_break_away},
    Experiment{"stick-slip", "Stick-slip", "a spring whose end moves steadily pulls the mass",
               stick_slip_setup, run_stick_slip},
    Experiment{"hunting", "Hunting",
               "a sampled PID controller takes the mass to a target and never rests, since the "
               "integral breaks it away again and again",
               hunting_setup, run_hunting},
    Experiment{"hysteresis", "Hysteresis",
               "slow sinusoidal motions of several amplitudes, each until its loop is steady",
               hysteresis_setup, run_hysteresis},
};

// Compares names, with a hyphen equal to an underscore.
bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    const auto hyphen = [](char c) { return c == '_' ? '-' : c; };
    return hyphen(x) == hyphen(y);
  });
}

// Returns the numbers of a list separated by commas. Throws InputError for one that is not above 0.
std::vector<double> positive_numbers(std::string_view assignment, std::string_view text) {
  std::vector<double> numbers;
  for (bool more = true; more;) {
    const std::size_t comma = text.find(',');
    const std::string_view field = text.substr(0, comma);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value) ||
        !(value > 0.0)) {
      throw InputError(fmt::format("--setup {}: '{}' is not a number above 0", assignment, field));
    }
    numbers.push_back(value);
    more = comma != std::string_view::npos;
    text.remove_prefix(more ? comma + 1 : text.size());
  }
  return numbers;
}

}  // namespace

void Setup::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw InputError(fmt::format("--setup {}: write NAME=VALUE", assignment));
  }
  const std::string_view name = assignment.substr(0, equals);
  const auto found = std::ranges::find(values_, name, &SetupValue::name);
  if (found == values_.end()) {
    std::vector<std::string_view> names;
    std::ranges::transform(values_, std::back_inserter(names), &SetupValue::name);
    throw InputError(fmt::format("--setup {}: this experiment has no such value; it has {}", name,
                                 fmt::join(names, ", ")));
  }
  std::vector<double> numbers = positive_numbers(assignment, assignment.substr(equals + 1));
  if (!found->is_list && numbers.size() != 1) {
    throw InputError(fmt::format("--setup {}: {} is one number", assignment, name));
  }
  found->value = std::move(numbers);
}

const std::vector<double>& Setup::list(std::string_view name) const {
  return std::ranges::find(values_, name, &SetupValue::name)->value;
}

double ExperimentRun::holding_force_N() const {
  return rendering::holding_level(friction) * normal_force_N;
}

std::span<const Experiment> experiments() {
  return kExperiments;
}

const Experiment& experiment(std::string_view name) {
  const auto found = std::ranges::find_if(
      kExperiments, [name](const Experiment& known) { return same_name(known.name, name); });
  if (found == kExperiments.end()) {
    std::vector<std::string_view> names;
    std::ranges::transform(kExperiments, std::back_inserter(names), &Experiment::name);
    throw InputError(
        fmt::format("there is no experiment '{}'; there are {}", name, fmt::join(names, ", ")));
  }
  return *found;
}

std::string experiment_help() {
  std::string text = "Experiments, and what --setup can change in them (default: as published):\n";
  for (const Experiment& known : kExperiments) {
    text += fmt::format("  {}: {}\n", known.name, known.what);
    const Setup setup = known.setup();
    for (const SetupValue& value : setup.values()) {
      text += fmt::format("    {:<18}{:<26}{}\n", value.name,
                          fmt::format("{}", fmt::join(value.value, ",")), value.meaning);
    }
  }
  return text;
}

}  // namespace tactus::host
