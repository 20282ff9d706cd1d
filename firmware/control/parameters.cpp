// Controller::parameter and Controller::set_parameter. They are lists of cases and not a table of
// pointers, because values reach the parts that use them in more than one way.
#include "firmware/control/parameters.h"

#include <cmath>

#include "firmware/control/controller.h"

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

// Returns true for a ramp, whose length must not change while it rises.
bool waits_for_rest(Parameter parameter) {
  return parameter == Parameter::soft_start || parameter == Parameter::contact_start;
}

}  // namespace

std::expected<ParameterValue, ParameterRefusal> Controller::parameter(
    const ParameterPlace& place) const {
  const SafetyConfig& now = config_.safety;
  switch (place.parameter) {
    case Parameter::max_force:
      return ParameterValue{now.max_force_N, 0.0, configured_safety_.max_force_N};
    case Parameter::force_slew:
      return ParameterValue{now.force_slew_N_per_s, kSlowestSlew_N_per_s,
                            configured_safety_.force_slew_N_per_s};
    case Parameter::soft_start:
      return ParameterValue{now.soft_start_s, configured_safety_.soft_start_s, kLongestStart_s};
    case Parameter::contact_start:
      return ParameterValue{now.contact_start_s, configured_safety_.contact_start_s,
                            kLongestStart_s};
    case Parameter::velocity_cutoff:
      return ParameterValue{config_.velocity_cutoff_hz, 0.0, config_.rate_hz};
    default:
      break;
  }
  if (text_of(place.parameter) == nullptr) {
    return std::unexpected(ParameterRefusal::no_such_parameter);
  }
  if (place.object >= world_.object_count()) {
    return std::unexpected(ParameterRefusal::no_such_object);
  }
  const rendering::Material material = material_changes_.wanted(world_, place.object);
  if (!has_term(place.parameter, material.friction.kind)) {
    return std::unexpected(ParameterRefusal::not_of_this_model);
  }
  return material_value(place.parameter, material);
}

std::expected<ParameterEvent, ParameterRefusal> Controller::set_parameter(
    const ParameterChange& change) {
  const auto now = parameter(change.place);
  if (!now) {
    return std::unexpected(now.error());
  }
  if (!std::isfinite(change.value)) {
    return std::unexpected(ParameterRefusal::not_finite);
  }
  if (change.value < now->least || change.value > now->greatest) {
    return std::unexpected(ParameterRefusal::out_of_range);
  }
  if (waits_for_rest(change.place.parameter) && mode_ == Mode::active) {
    return std::unexpected(ParameterRefusal::not_while_active);
  }
  if (is_of_object(change.place.parameter)) {
    rendering::Material material = material_changes_.wanted(world_, change.place.object);
    material_field(change.place.parameter, material) = change.value;
    if (!is_certified(change.place.object, material)) {
      return std::unexpected(ParameterRefusal::uncertified);
    }
    // The present material is set as a changed one first; the ticks then apply the change
    // gradually.
    const rendering::Material felt = world_.material(change.place.object);
    if (!world_.set_material(change.place.object, felt)) {
      return std::unexpected(ParameterRefusal::too_many_changed);
    }
    material_changes_.set(change.place.object, material);
  } else {
    apply_own(change);
  }
  change_ = change;
  return ParameterEvent{.tick = next_tick_, .change = change};
}

// Returns the loaded scene as the certificate sees it. `materials` must outlive the result.
FeltScene Controller::felt_scene(const WantedMaterials& materials, const SafetyConfig& safety) {
  const Controller& controller = *materials.controller;
  const auto wanted = [](const void* context, std::uint32_t object) {
    const auto& [of, changed, number] = *static_cast<const WantedMaterials*>(context);
    return changed != nullptr && object == number
               ? *changed
               : of->material_changes_.wanted(of->world_, object);
  };
  return {.objects = controller.objects_,
          .effects = controller.effects_,
          .feel = {.tool_radius_m = controller.tool_radius_m_,
                   .max_force_N = safety.max_force_N,
                   .material = wanted,
                   .context = &materials,
                   .walls = felt_walls(safety)}};
}

bool Controller::is_certified(std::uint32_t object, const rendering::Material& material) {
  if (config_.allow_uncertified) {
    return true;
  }
  const WantedMaterials materials{.controller = this, .changed = &material, .object = object};
  const FeltScene scene = felt_scene(materials, configured_safety_);
  const auto part = uncertified_with(config_.certificate, scene, object);
  uncertified_part_ = part.value_or(uncertified_part_);
  return !part;
}

// Applies a change of one of the controller's own parameters. The value is within its range.
void Controller::apply_own(const ParameterChange& change) {
  switch (change.place.parameter) {
    case Parameter::max_force:
      config_.safety.max_force_N = change.value;
      break;
    case Parameter::force_slew:
      config_.safety.force_slew_N_per_s = change.value;
      break;
    case Parameter::soft_start:
      config_.safety.soft_start_s = change.value;
      break;
    case Parameter::contact_start:
      config_.safety.contact_start_s = change.value;
      break;
    default:
      config_.velocity_cutoff_hz = change.value;
      break;
  }
  retune();
}

// Passes the controller's own parameters to the parts that use them.
void Controller::retune() {
  force_limiter_.retune(config_);
  velocity_filter_.retune(config_.velocity_cutoff_hz, config_.rate_hz);
  gravity_compensation_.retune(config_);
  friction_compensation_.retune(config_);
}

}  // namespace tactus::firmware
