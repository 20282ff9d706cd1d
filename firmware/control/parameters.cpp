// Controller::parameter and Controller::set_parameter. They are lists of cases and not a table of
// pointers, because values reach the parts that use them in more than one way.
#include "firmware/control/parameters.h"

#include <cmath>

#include "firmware/control/controller.h"
#include "firmware/control/parameter_choices.h"
#include "rendering/material/friction_exchange.h"

namespace tactus::firmware {
namespace {

// The largest values that a command may set for an object, far beyond any device.
constexpr double kStiffestSet_N_per_m = 1e6;
constexpr double kMostDampingSet_Ns_per_m = 1e4;
constexpr double kMostFrictionSet = 10.0;
constexpr double kLongestStart_s = 60.0;
constexpr double kSlowestSlew_N_per_s = 1.0;

// Returns the value and the range of an object's parameter. The static friction must not fall below
// the dynamic one, so each is an end of the other's range.
ParameterValue material_value(Parameter parameter, const rendering::Material& material) {
  const rendering::FrictionParameters& friction = material.friction;
  switch (parameter) {
    case Parameter::stiffness:
      return {material.stiffness_N_per_m, 0.0, kStiffestSet_N_per_m};
    case Parameter::damping:
      return {material.damping_Ns_per_m, 0.0, kMostDampingSet_Ns_per_m};
    case Parameter::static_friction:
      return {friction.static_level, friction.coulomb, kMostFrictionSet};
    case Parameter::dynamic_friction:
      return {
          friction.coulomb, 0.0,
          rendering::has_static_level(friction.kind) ? friction.static_level : kMostFrictionSet};
    default:
      return {friction.viscous_s_per_m, 0.0, kMostFrictionSet};
  }
}

// Returns the field of a material that an object's parameter names.
double& material_field(Parameter parameter, rendering::Material& material) {
  switch (parameter) {
    case Parameter::stiffness:
      return material.stiffness_N_per_m;
    case Parameter::damping:
      return material.damping_Ns_per_m;
    case Parameter::static_friction:
      return material.friction.static_level;
    case Parameter::dynamic_friction:
      return material.friction.coulomb;
    default:
      return material.friction.viscous_s_per_m;
  }
}

// Returns true if friction of that kind uses the parameter.
bool has_term(Parameter parameter, rendering::FrictionKind kind) {
  switch (parameter) {
    case Parameter::static_friction:
      return rendering::has_static_level(kind);
    case Parameter::viscous_friction:
      return rendering::is_viscous(kind);
    default:
      return true;
  }
}

// Returns the bits of the values from 0 to below `count` for which `allows` is true.
template <class Allows>
std::uint32_t choices_from(std::uint32_t count, const Allows& allows) {
  std::uint32_t choices = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    choices |= allows(i) ? 1U << i : 0U;
  }
  return choices;
}

// Returns the friction model of an object, and those that its contact method can render.
ParameterValue model_value(const LoadedScene& scene, std::uint32_t object) {
  const std::uint32_t count = choice_count(Parameter::friction_model);
  const rendering::ContactMethod method = scene.world.object(object).method;
  return {.value = static_cast<double>(scene.wanted(object).friction.kind),
          .greatest = count - 1.0,
          .choices = choices_from(count, [&](std::uint32_t i) {
            const auto material = scene.with_model(object, static_cast<rendering::FrictionKind>(i));
            return sound(material) && rubs_at_rest(material.friction) &&
                   renders_friction(method, material.friction);
          })};
}

// Returns the contact method of an object, and those that can render it.
ParameterValue contact_value(const LoadedScene& scene, std::uint32_t number) {
  const std::uint32_t count = choice_count(Parameter::contact);
  const rendering::Object& object = scene.world.object(number);
  const rendering::Material material = scene.wanted(number);
  return {.value = static_cast<double>(object.method),
          .greatest = count - 1.0,
          .choices = choices_from(count, [&](std::uint32_t i) {
            return can_render(static_cast<rendering::ContactMethod>(i), object, material);
          })};
}

// Returns true for a ramp, whose length must not change while it rises.
bool waits_for_rest(Parameter parameter) {
  return parameter == Parameter::soft_start || parameter == Parameter::contact_start;
}

}  // namespace

ParameterValue DeviceController::own_parameter(Parameter parameter) const {
  const auto& [config, configured, is_configured] = settings_;
  const SafetyConfig& now = config.safety;
  switch (parameter) {
    case Parameter::max_force:
      return {now.max_force_N, 0.0, configured.max_force_N};
    case Parameter::force_slew:
      return {now.force_slew_N_per_s, kSlowestSlew_N_per_s, configured.force_slew_N_per_s};
    case Parameter::soft_start:
      return {now.soft_start_s, configured.soft_start_s, kLongestStart_s};
    case Parameter::contact_start:
      return {now.contact_start_s, configured.contact_start_s, kLongestStart_s};
    default:
      return {config.velocity_cutoff_hz, 0.0, config.rate_hz};
  }
}

ParameterEvent DeviceController::record_change(const ParameterChange& change) {
  next_.change = change;
  return {.tick = next_.number, .change = change};
}

std::expected<ParameterValue, ParameterRefusal> Controller::parameter(const ParameterPlace& place,
                                                                      std::size_t device) const {
  if (text_of(place.parameter) == nullptr) {
    return std::unexpected(ParameterRefusal::no_such_parameter);
  }
  if (!is_of_object(place.parameter)) {
    return at(device).own_parameter(place.parameter);
  }
  if (place.object >= scene_.world.object_count()) {
    return std::unexpected(ParameterRefusal::no_such_object);
  }
  if (place.parameter == Parameter::friction_model) {
    return model_value(scene_, place.object);
  }
  if (place.parameter == Parameter::contact) {
    return contact_value(scene_, place.object);
  }
  const rendering::Material material = scene_.wanted(place.object);
  if (!has_term(place.parameter, material.friction.kind)) {
    return std::unexpected(ParameterRefusal::not_of_this_model);
  }
  return material_value(place.parameter, material);
}

std::expected<ParameterEvent, ParameterRefusal> Controller::set_parameter(
    const ParameterChange& change, std::size_t device) {
  const Parameter parameter = change.place.parameter;
  const auto now = this->parameter(change.place, device);
  if (!now) {
    return std::unexpected(now.error());
  }
  if (!std::isfinite(change.value)) {
    return std::unexpected(ParameterRefusal::not_finite);
  }
  if (has_choices(parameter)) {
    if (!allows(*now, change.value)) {
      return std::unexpected(ParameterRefusal::not_a_choice);
    }
  } else if (change.value < now->least || change.value > now->greatest) {
    return std::unexpected(ParameterRefusal::out_of_range);
  }
  if (waits_for_rest(parameter) && mode(device) == Mode::active) {
    return std::unexpected(ParameterRefusal::not_while_active);
  }
  const bool is_chosen_already = has_choices(parameter) && change.value == now->value;
  if (!is_of_object(parameter)) {
    at(device).set_own(change);
  } else if (!is_chosen_already) {
    if (const auto changed = change_object(change); !changed) {
      return std::unexpected(changed.error());
    }
  }
  return at(device).record_change(change);
}

std::expected<void, ParameterRefusal> Controller::change_object(const ParameterChange& change) {
  const auto& [parameter, object] = change.place;
  if (parameter == Parameter::friction_model) {
    return choose_model(change);
  }
  if (parameter == Parameter::contact) {
    return choose_contact(change);
  }
  rendering::Material material = scene_.wanted(object);
  material_field(parameter, material) = change.value;
  if (!is_certified(object, material, scene_.world.object(object).method)) {
    return std::unexpected(ParameterRefusal::uncertified);
  }
  if (!scene_.change_material(object, material)) {
    return std::unexpected(ParameterRefusal::too_many_changed);
  }
  return {};
}

bool Controller::is_certified(std::uint32_t object, const rendering::Material& material,
                              rendering::ContactMethod method) {
  for (std::size_t i = 0; i < device_count(); ++i) {
    const ControllerConfig& device = config(i);
    if (!device.allow_uncertified &&
        !scene_.is_certified(device.certificate, device.safety, object, material, method)) {
      return false;
    }
  }
  return true;
}

// Gives an object another friction model at once. A model that a contact has driven could not go on
// with the force of another one, so the contact must be over.
std::expected<void, ParameterRefusal> Controller::choose_model(const ParameterChange& change) {
  const std::uint32_t object = change.place.object;
  const rendering::Material material =
      scene_.with_model(object, static_cast<rendering::FrictionKind>(change.value));
  if (scene_.world.is_touched(object)) {
    return std::unexpected(ParameterRefusal::touched);
  }
  if (!is_certified(object, material, scene_.world.object(object).method)) {
    return std::unexpected(ParameterRefusal::uncertified);
  }
  if (!scene_.exchange_material(object, material)) {
    return std::unexpected(ParameterRefusal::too_many_changed);
  }
  return {};
}

// Gives an object another contact method at once.
std::expected<void, ParameterRefusal> Controller::choose_contact(const ParameterChange& change) {
  const std::uint32_t object = change.place.object;
  const auto method = static_cast<rendering::ContactMethod>(change.value);
  rendering::World& world = scene_.world;
  if (!world.may_set_method(object, method)) {
    return std::unexpected(ParameterRefusal::touched);
  }
  if (!is_certified(object, scene_.wanted(object), method)) {
    return std::unexpected(ParameterRefusal::uncertified);
  }
  if (!world.has_room_for(object, method)) {
    return std::unexpected(ParameterRefusal::too_many_contacts);
  }
  if (!world.set_method(object, method)) {
    return std::unexpected(ParameterRefusal::too_many_changed);
  }
  return {};
}

void DeviceController::set_own(const ParameterChange& change) {
  SafetyConfig& safety = settings_.config.safety;
  switch (change.place.parameter) {
    case Parameter::max_force:
      safety.max_force_N = change.value;
      break;
    case Parameter::force_slew:
      safety.force_slew_N_per_s = change.value;
      break;
    case Parameter::soft_start:
      safety.soft_start_s = change.value;
      break;
    case Parameter::contact_start:
      safety.contact_start_s = change.value;
      break;
    default:
      settings_.config.velocity_cutoff_hz = change.value;
      break;
  }
  retune();
}

// Passes the controller's own parameters to the parts that use them.
void DeviceController::retune() {
  const ControllerConfig& config = settings_.config;
  force_path_.limiter.retune(config);
  locator_.velocity_filter.retune(config.velocity_cutoff_hz, config.rate_hz);
  effort_path_.gravity.retune(config);
  effort_path_.friction.retune(config);
}

}  // namespace tactus::firmware
