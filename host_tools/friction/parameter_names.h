// The names of the friction models and their parameters: those of the papers, which the command
// line uses, and those of TOML files. `tactus friction`, `tactus fit` and baking share the table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/friction/friction_model.h"

namespace tactus::host {

// Returns what a model says of itself: its names and its parameters.
const rendering::FrictionModelTraits& model_of(rendering::FrictionKind kind);

// A hyphen counts as an underscore. Throws InputError, listing the names, if there is no such
// model.
rendering::FrictionKind friction_kind(std::string_view name);

// The unit of a model's forces: N where no normal force is given, as in a joint, and else per
// newton of the normal force, as on a surface.
enum class ForceScale { newton, per_newton };

enum class ParameterRange { zero_or_more, above_zero, share };

struct FrictionParameterName {
  std::string_view symbol;  // sigma0
  double rendering::FrictionParameters::* member;
  ParameterRange range;
  std::string_view unit;          // ForceScale::newton
  std::string_view surface_unit;  // ForceScale::per_newton
  std::string_view joint_key;     // in TOML, ForceScale::newton
  std::string_view surface_key;   // in TOML, ForceScale::per_newton
  std::string_view meaning;

  [[nodiscard]] rendering::FrictionKinds kinds() const { return rendering::kinds_with(member); }
  [[nodiscard]] std::string_view unit_of(ForceScale scale) const {
    return scale == ForceScale::newton ? unit : surface_unit;
  }
  [[nodiscard]] std::string_view key_of(ForceScale scale) const {
    return scale == ForceScale::newton ? joint_key : surface_key;
  }
};

// Returns the names of the parameters of all models.
std::span<const FrictionParameterName> friction_parameter_names();
const FrictionParameterName& parameter_name(std::string_view symbol);
std::vector<FrictionParameterName> parameters_of(rendering::FrictionKind kind);

// Table I of the LuGre paper, for 1 N; the models without bristles are rigid.
rendering::FrictionParameters published_parameters(rendering::FrictionKind kind);

// Takes over "sigma0=1e5" and the like. Throws InputError: not of that form, a name that the model
// does not have (with the list of those it has), not a number, out of range; each with the unit.
void set_parameter(rendering::FrictionParameters& parameters, std::string_view assignment,
                   ForceScale scale);

// Throws InputError where Fs is below Fc, or a model lacks the stiffness that it needs.
void check_parameters(const rendering::FrictionParameters& parameters, ForceScale scale);

// Returns "a, b or c" of at least two names, with `last_joint` "or".
std::string in_words(std::span<const std::string_view> names, std::string_view last_joint);

// Returns the names of all models in words: for --help.
std::string model_help();

// One line a parameter, with units, default and which models have it: for --help.
std::string parameter_help();

}  // namespace tactus::host
