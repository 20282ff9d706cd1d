// The names of the friction models and their parameters: those of the papers, which the command
// line uses, and those of TOML files. `tactus friction`, `tactus fit` and baking share the table. A
// new parameter is a row in parameter_names.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/friction/friction_model.h"

namespace tactus::host {

// Returns what a model says of itself: its names and its parameters.
const rendering::FrictionModelTraits& model_of(rendering::FrictionKind kind);

// Returns a model by its name, in which a hyphen and an underscore are the same. Throws InputError
// with the names if there is none.
rendering::FrictionKind friction_kind(std::string_view name);

// The unit of a model's forces: N if no normal force is given, as in a joint, else per newton of
// the normal force, as on a surface.
enum class ForceScale { newton, per_newton };

// The values that a parameter may have; `share` lies between 0 and 1, both excluded.
enum class ParameterRange { zero_or_more, above_zero, share };

// A parameter with its names, units and models.
struct FrictionParameterName {
  // Its symbol in the papers, such as sigma0.
  std::string_view symbol;
  // The member that holds its value.
  double rendering::FrictionParameters::* member;
  ParameterRange range;
  // Its unit and its key in TOML for a joint (ForceScale::newton) and for a surface
  // (ForceScale::per_newton).
  std::string_view unit;
  std::string_view surface_unit;
  std::string_view joint_key;
  std::string_view surface_key;
  // Its meaning, in words for --help.
  std::string_view meaning;
  // Returns the models that have this parameter.
  [[nodiscard]] rendering::FrictionKinds kinds() const { return rendering::kinds_with(member); }
  // Return its unit and its key in TOML for that scale.
  [[nodiscard]] std::string_view unit_of(ForceScale scale) const {
    return scale == ForceScale::newton ? unit : surface_unit;
  }
  [[nodiscard]] std::string_view key_of(ForceScale scale) const {
    return scale == ForceScale::newton ? joint_key : surface_key;
  }
};

// Returns the names of the parameters of all models.
std::span<const FrictionParameterName> friction_parameter_names();
// Returns a parameter by its symbol, which must exist.
const FrictionParameterName& parameter_name(std::string_view symbol);
// Returns the parameters of one model.
std::vector<FrictionParameterName> parameters_of(rendering::FrictionKind kind);

// Returns table I of the LuGre paper, for 1 N. Models without bristles are rigid.
rendering::FrictionParameters published_parameters(rendering::FrictionKind kind);

// Takes over a text like "sigma0=1e5". Throws InputError, with the unit, if it does not have that
// form, the model has no such parameter, or the value is no number or out of range.
void set_parameter(rendering::FrictionParameters& parameters, std::string_view assignment,
                   ForceScale scale);

// Returns the published parameters of a model with changes like "sigma0=1e5". Throws InputError as
// the functions below and above do.
rendering::FrictionParameters changed_parameters(std::string_view model,
                                                 std::span<const std::string> assignments,
                                                 ForceScale scale);

// Throws InputError if Fs is below Fc, or a model lacks the stiffness that it needs.
void check_parameters(const rendering::FrictionParameters& parameters, ForceScale scale);

// Returns "a, b or c" of at least two names, with `last_joint` "or".
std::string in_words(std::span<const std::string_view> names, std::string_view last_joint);

// Returns the names of all models in words: for --help.
std::string model_help();

// Returns one line a parameter, with unit, default and models, for --help.
std::string parameter_help();

}  // namespace tactus::host
