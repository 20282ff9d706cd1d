#include "host_tools/friction/parameter_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <ranges>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionModelTraits;
using rendering::FrictionParameters;
using rendering::kFrictionModels;

constexpr std::array kParameterNames{
    FrictionParameterName{"Fc", &FrictionParameters::coulomb, ParameterRange::zero_or_more, "N",
                          "N/N", "coulomb_N", "dynamic", "friction of a fast slip"},
    FrictionParameterName{"Fs", &FrictionParameters::static_level, ParameterRange::zero_or_more,
                          "N", "N/N", "static_N", "static",
                          "friction at rest, at most; not below Fc"},
    FrictionParameterName{"sigma2", &FrictionParameters::viscous_s_per_m,
                          ParameterRange::zero_or_more, "N s/m", "s/m", "viscous_Ns_per_m",
                          "viscous_s_per_m", "viscous friction"},
    FrictionParameterName{"vs", &FrictionParameters::stribeck_velocity_m_per_s,
                          ParameterRange::above_zero, "m/s", "m/s", "stribeck_velocity_m_per_s",
                          "stribeck_velocity_m_per_s", "speed by which Fs has fallen to Fc"},
    FrictionParameterName{"alpha", &FrictionParameters::stribeck_exponent,
                          ParameterRange::above_zero, "1", "1", "stribeck_exponent",
                          "stribeck_exponent", "exponent of |v/vs| in that fall"},
    FrictionParameterName{"sigma0", &FrictionParameters::stiffness_N_per_m,
                          ParameterRange::zero_or_more, "N/m", "N/m", "stiffness_N_per_m",
                          "stiffness_N_per_m",
                          "stiffness of the bristles; 0: rigid, where the model can be"},
    FrictionParameterName{"sigma1", &FrictionParameters::damping_s_per_m,
                          ParameterRange::zero_or_more, "N s/m", "s/m", "damping_Ns_per_m",
                          "damping_s_per_m", "damping of the bristles; none where rigid"},
    FrictionParameterName{"vd", &FrictionParameters::damping_fade_m_per_s,
                          ParameterRange::zero_or_more, "m/s", "m/s", "damping_fade_m_per_s",
                          "damping_fade_m_per_s",
                          "sigma1 fades with speed as exp(-(v/vd)^2); 0: it does not"},
    FrictionParameterName{"band", &FrictionParameters::stick_velocity_m_per_s,
                          ParameterRange::above_zero, "m/s", "m/s", "stick_velocity_m_per_s",
                          "stick_velocity_m_per_s", "speed below which a slip ends"},
    FrictionParameterName{"zba", &FrictionParameters::elastic_fraction, ParameterRange::share,
                          "Fc/sigma0", "Fc/sigma0", "elastic_fraction", "elastic_fraction",
                          "how far a bristle bends without yielding"},
};

template <class Predicate>
std::vector<std::string_view> names_of(const Predicate& is_meant) {
  std::vector<std::string_view> names;
  for (const FrictionModelTraits& model : kFrictionModels) {
    if (is_meant(model)) {
      names.push_back(model.name);
    }
  }
  return names;
}

// Returns the name with underscores for hyphens.
std::string plain(std::string_view name) {
  std::string result(name);
  std::ranges::replace(result, '-', '_');
  return result;
}

std::string_view bound_in_words(ParameterRange range) {
  switch (range) {
    case ParameterRange::zero_or_more:
      return "0 or more";
    case ParameterRange::above_zero:
      return "above 0";
    default:
      return "between 0 and 1";
  }
}

bool is_within(ParameterRange range, double value) {
  switch (range) {
    case ParameterRange::zero_or_more:
      return value >= 0.0;
    case ParameterRange::above_zero:
      return value > 0.0;
    default:
      return value > 0.0 && value < 1.0;
  }
}

std::string with_unit(const FrictionParameterName& name, ForceScale scale) {
  return fmt::format("{} ({})", name.symbol, name.unit_of(scale));
}

// Returns the model's parameter of that symbol. Throws InputError with those that it has.
const FrictionParameterName& parameter_of(FrictionKind kind, std::string_view symbol,
                                          ForceScale scale) {
  const auto found = std::ranges::find(kParameterNames, symbol, &FrictionParameterName::symbol);
  if (found != kParameterNames.end() && model_of(kind).has(found->member)) {
    return *found;
  }
  std::vector<std::string> known;
  for (const FrictionParameterName& name : kParameterNames) {
    if (model_of(kind).has(name.member)) {
      known.push_back(with_unit(name, scale));
    }
  }
  throw InputError(fmt::format("--param {}: model {} has no such parameter; it has {}", symbol,
                               model_of(kind).name, fmt::join(known, ", ")));
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

const FrictionModelTraits& model_of(FrictionKind kind) {
  return kFrictionModels.at(static_cast<std::size_t>(kind));
}

FrictionKind friction_kind(std::string_view name) {
  const auto* const found =
      std::ranges::find(kFrictionModels, plain(name), &FrictionModelTraits::name);
  if (found == kFrictionModels.end()) {
    throw InputError(fmt::format(
        "there is no friction model '{}'; there are {}", name,
        fmt::join(kFrictionModels | std::views::transform(&FrictionModelTraits::name), ", ")));
  }
  return found->kind;
}

std::span<const FrictionParameterName> friction_parameter_names() {
  return kParameterNames;
}

const FrictionParameterName& parameter_name(std::string_view symbol) {
  return *std::ranges::find(kParameterNames, symbol, &FrictionParameterName::symbol);
}

std::vector<FrictionParameterName> parameters_of(FrictionKind kind) {
  std::vector<FrictionParameterName> result;
  std::ranges::copy_if(kParameterNames, std::back_inserter(result),
                       [kind](const auto& name) { return model_of(kind).has(name.member); });
  return result;
}

FrictionParameters published_parameters(FrictionKind kind) {
  constexpr double kBristleStiffness_N_per_m = 1e5;
  return {.kind = kind,
          .coulomb = 1.0,
          .static_level = 1.5,
          .viscous_s_per_m = 0.4,
          .stribeck_velocity_m_per_s = 1e-3,
          .stribeck_exponent = 2.0,
          .stiffness_N_per_m = rendering::has_bristles(kind) ? kBristleStiffness_N_per_m : 0.0,
          // Table I: sigma1 = sqrt(sigma0).
          .damping_s_per_m = std::sqrt(kBristleStiffness_N_per_m),
          .damping_fade_m_per_s = 0.0,
          .stick_velocity_m_per_s = 1e-3,
          .elastic_fraction = 0.7};
}

void set_parameter(FrictionParameters& parameters, std::string_view assignment, ForceScale scale) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw InputError(
        fmt::format("--param {}: write NAME=VALUE, like --param sigma0=1e5", assignment));
  }
  const FrictionParameterName& name =
      parameter_of(parameters.kind, assignment.substr(0, equals), scale);
  const std::string_view text = assignment.substr(equals + 1);
  const std::optional<double> value = number_in(text);
  if (!value) {
    throw InputError(fmt::format("--param {}: '{}' is not a finite number; {} is in {}", assignment,
                                 text, name.symbol, name.unit_of(scale)));
  }
  if (!is_within(name.range, *value)) {
    throw InputError(fmt::format("--param {}: {} must be {} {}", assignment, name.symbol,
                                 bound_in_words(name.range), name.unit_of(scale)));
  }
  parameters.*name.member = *value;
}

void check_parameters(const FrictionParameters& parameters, ForceScale scale) {
  const std::string_view unit = parameter_name("Fs").unit_of(scale);
  if (rendering::has_static_level(parameters.kind) &&
      parameters.static_level < parameters.coulomb) {
    throw InputError(
        fmt::format("--param: Fs is {} {} and Fc is {} {}, but Fs must not be below Fc; give both",
                    parameters.static_level, unit, parameters.coulomb, unit));
  }
  if (rendering::has_bristles(parameters.kind) && !(parameters.stiffness_N_per_m > 0.0)) {
    throw InputError(fmt::format("--param sigma0=0: model {} needs a sigma0 above 0 N/m",
                                 model_of(parameters.kind).name));
  }
  if (!rendering::valid(parameters)) {
    throw InputError("--param: the model refuses these parameters");
  }
}

rendering::FrictionParameters changed_parameters(std::string_view model,
                                                 std::span<const std::string> assignments,
                                                 ForceScale scale) {
  rendering::FrictionParameters parameters = published_parameters(friction_kind(model));
  for (const std::string& assignment : assignments) {
    set_parameter(parameters, assignment, scale);
  }
  check_parameters(parameters, scale);
  return parameters;
}

std::string in_words(std::span<const std::string_view> names, std::string_view last_joint) {
  const auto first = names.first(names.size() - 1);
  return fmt::format("{} {} {}", fmt::join(first, ", "), last_joint, names.back());
}

std::string model_help() {
  return in_words(names_of([](const FrictionModelTraits& /*model*/) { return true; }), "or");
}

std::string parameter_help() {
  std::string text =
      "Parameters (default: table I of the LuGre paper), in this unit, or in the one in brackets "
      "with a normal force:\n";
  const FrictionParameters defaults = published_parameters(FrictionKind::lugre);
  for (const FrictionParameterName& name : kParameterNames) {
    const std::vector<std::string_view> models =
        names_of([&](const FrictionModelTraits& model) { return model.has(name.member); });
    const std::string unit = name.unit == name.surface_unit
                                 ? std::string(name.unit)
                                 : fmt::format("{} ({})", name.unit, name.surface_unit);
    text += fmt::format("  {:<7}{:<12}{:<9.6g}{}\n{:30}of {}\n", name.symbol, unit,
                        defaults.*name.member, name.meaning, "",
                        models.size() == kFrictionModels.size()
                            ? "every model"
                            : fmt::format("{}", fmt::join(models, ", ")));
  }
  const std::vector<std::string_view> sliders =
      names_of([](const FrictionModelTraits& model) { return !model.has_bristles; });
  return text + fmt::format("{} are rigid unless sigma0 is given.\n", in_words(sliders, "and"));
}

}  // namespace tactus::host
