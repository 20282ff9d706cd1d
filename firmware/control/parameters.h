// The parameters that may be changed while the controller runs: their names and units, and the
// reasons to refuse a value.
//
// Controller::set_parameter applies a change between two ticks. The record of the first tick with
// the change contains it, so equal inputs and changes give equal ticks. While the motors are on,
// changes of materials and a higher largest force act gradually, so that no change pushes the hand
// (control/material_changes.h, safety/force_limiter.h).
//
// Safety limits can be made gentler than in the device's file, never harder: the file's values are
// the ends of their ranges. Materials can be changed either way, up to the certified stiffness if
// the device has a certificate. The friction model and the contact method of an object change at
// once, and only while no tool touches it: a change under a hand would be a step of the force.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// The parameters. The numbers are stable, because recordings contain them.
enum class Parameter : std::uint8_t {
  none = 0,
  max_force = 1,
  force_slew = 2,
  soft_start = 3,
  contact_start = 4,
  velocity_cutoff = 5,
  stiffness = 16,  // this and the following belong to an object
  damping = 17,
  static_friction = 18,
  dynamic_friction = 19,
  viscous_friction = 20,
  friction_model = 21,  // this and the following have names for values (parameter_choices.h)
  contact = 22,
};

// The last of the parameters.
inline constexpr Parameter kLastParameter = Parameter::contact;

// Returns true for a parameter of an object of the scene, false for the controller's own.
constexpr bool is_of_object(Parameter parameter) {
  return parameter >= Parameter::stiffness;
}

// The texts of a parameter.
struct ParameterText {
  Parameter parameter;
  // The name for programs, with the unit. An object's parameter is written object.<name or
  // number>.<name>.
  std::string_view name;
  std::string_view unit;  // empty if the values have names
  // The meaning for people.
  std::string_view meaning;
};

// The texts, in the order of the numbers.
inline constexpr auto kParameterTexts = std::to_array<ParameterText>({
    {Parameter::max_force, "max_force_N", "N", "largest force on the hand"},
    {Parameter::force_slew, "force_slew_N_per_s", "N/s", "fastest change of the force"},
    {Parameter::soft_start, "soft_start_s", "s",
     "rise of the force from activation; not in active"},
    {Parameter::contact_start, "contact_start_s", "s",
     "rise of the force from the first contact; not in active"},
    {Parameter::velocity_cutoff, "velocity_cutoff_hz", "Hz",
     "low-pass on the tool's velocity, 0 for none"},
    {Parameter::stiffness, "stiffness_N_per_m", "N/m", "stiffness of an object"},
    {Parameter::damping, "damping_Ns_per_m", "Ns/m", "damping of an object"},
    {Parameter::static_friction, "static_friction", "1",
     "friction coefficient of an object at rest, not below the dynamic one"},
    {Parameter::dynamic_friction, "dynamic_friction", "1",
     "friction coefficient of an object in motion"},
    {Parameter::viscous_friction, "viscous_friction_s_per_m", "s/m",
     "friction of an object that grows with the speed, per newton of normal force"},
    {Parameter::friction_model, "friction_model", "",
     "friction model of an object; not while it is touched"},
    {Parameter::contact, "contact", "", "contact method of an object; not while it is touched"},
});

// Returns the row of kParameterTexts; nullptr for `none` and for an unknown number.
constexpr const ParameterText* text_of(Parameter parameter) {
  for (const ParameterText& text : kParameterTexts) {
    if (text.parameter == parameter) {
      return &text;
    }
  }
  return nullptr;
}

// A parameter of the controller or of an object of the scene.
struct ParameterPlace {
  Parameter parameter = Parameter::none;
  std::uint32_t object = 0;  // index of the object; ignored for the controller's own parameters

  bool operator==(const ParameterPlace&) const = default;
};

// A new value of a parameter, in its unit. `place.parameter` is `none` if nothing changed.
struct ParameterChange {
  ParameterPlace place;
  // The new value, in the parameter's unit.
  double value = 0.0;
};

// A change that took effect.
struct ParameterEvent {
  // The number of the first tick with the change.
  std::uint64_t tick = 0;
  ParameterChange change;
};

// A value and its allowed range, both ends included, in the parameter's unit.
struct ParameterValue {
  double value = 0.0;
  double least = 0.0;
  double greatest = 0.0;
  // The allowed values of a parameter whose values have names: bit 1 << value for each.
  std::uint32_t choices = 0;
};

// Why a parameter was not read or changed.
enum class ParameterRefusal : std::uint8_t {
  no_such_parameter,
  no_such_object,
  not_finite,
  out_of_range,
  not_while_active,   // disable first
  too_many_changed,   // kMaxChangedObjects objects have been changed since the scene was loaded
  not_of_this_model,  // the object's friction model has no such term
  not_a_choice,       // no such name, or the object does not allow it
  touched,            // a tool is in contact; lift it first
  too_many_contacts,  // kMaxIndependentObjects objects have a contact of their own
  uncertified,        // beyond the device's certificate, alone or with other parts that push there
};

// Returns a text for people that says why and what to do, without a full stop.
constexpr std::string_view describe(ParameterRefusal refusal) {
  switch (refusal) {
    case ParameterRefusal::no_such_parameter:
      return "there is no such parameter; send list";
    case ParameterRefusal::no_such_object:
      return "the scene has no such object; send list";
    case ParameterRefusal::not_finite:
      return "the value is not a finite number";
    case ParameterRefusal::out_of_range:
      return "the value is out of its range";
    case ParameterRefusal::not_while_active:
      return "it cannot change while the mode is active; send disable first";
    case ParameterRefusal::too_many_changed:
      return "too many objects have been changed; load the scene again";
    case ParameterRefusal::not_of_this_model:
      return "the object's friction model has no such term";
    case ParameterRefusal::not_a_choice:
      return "there is no such value, or the object's shape, motion, friction, grain or textures "
             "do "
             "not go with it";
    case ParameterRefusal::touched:
      return "the tool touches the object, or another one by the proxy that they share; lift the "
             "tool and set it again";
    case ParameterRefusal::too_many_contacts:
      return "as many objects as fit have a contact of their own; set another object's contact to "
             "sphere_proxy first";
    case ParameterRefusal::uncertified:
      return "the device is not certified for so much, by itself or with what else is felt in that "
             "place; certify a stiffer device with tactus certify, or start with "
             "--allow-uncertified";
  }
  return {};
}

}  // namespace tactus::firmware
