// Controller::configure and Controller::load_scene.
#include <limits>
#include <optional>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"
#include "rendering/tick_budget.h"

namespace tactus::firmware {
namespace {

// Returns the part that the certificate refuses, or nothing if the configuration allows it.
std::optional<UncertifiedPart> unless_allowed(const ControllerConfig& config,
                                              const std::optional<UncertifiedPart>& part) {
  return config.allow_uncertified ? std::nullopt : part;
}

// Returns true if motions and effects of so many cost units leave half of a tick's budget to the
// contacts.
bool leaves_room(std::size_t standing_units, std::size_t budget_units) {
  return standing_units <= budget_units / 2;
}

// Returns the field of the configuration to which the refused part is attributed.
ConfigError uncertified_field(const UncertifiedPart& part) {
  const bool is_wall = part.kind == UncertifiedPart::Kind::wall;
  if (is_wall && part.damping_Ns_per_m > part.most_damping_Ns_per_m) {
    return {"safety.workspace_damping_Ns_per_m", part.damping_Ns_per_m, 0.0,
            part.most_damping_Ns_per_m};
  }
  return {is_wall ? "safety.workspace_stiffness_N_per_m" : "certificate", part.stiffness_N_per_m,
          0.0, part.limit_N_per_m};
}

}  // namespace

std::expected<void, ConfigError> Controller::configure(const ControllerConfig& config,
                                                       std::size_t device) {
  if (const auto valid = validate(config); !valid) {
    return valid;
  }
  if (const auto part =
          unless_allowed(config, scene_.first_refused(config.certificate, config.safety))) {
    return std::unexpected(uncertified_field(*part));
  }
  double budget = tick_instructions(config);
  if (!leaves_room(scene_.standing_units, rendering::units_of(budget))) {
    return std::unexpected(ConfigError{"tick_instructions", budget,
                                       2.0 * rendering::instructions_of(scene_.standing_units),
                                       std::numeric_limits<double>::infinity()});
  }
  for (std::size_t i = 0; i < device_count(); ++i) {
    if (i == device || !at(i).is_configured()) {
      continue;
    }
    const ControllerConfig& other = at(i).config();
    if (other.rate_hz != config.rate_hz) {
      return std::unexpected(ConfigError{"rate_hz", config.rate_hz, other.rate_hz, other.rate_hz});
    }
    budget = std::min(budget, tick_instructions(other));
  }
  at(device).configure(config);
  scene_.restart(1.0 / config.rate_hz, budget);
  return {};
}

std::expected<void, SceneRefusal> Controller::load_scene(std::span<const rendering::Object> objects,
                                                         const rendering::WorldConfig& config) {
  rendering::WorldConfig world = config;
  world.tool_count = device_count();
  if (const auto exceeded =
          rendering::first_exceeded(rendering::scene_counts(objects, world), rendering::kProfile)) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::capacity, .exceeded = *exceeded});
  }
  for (std::size_t i = 0; i < device_count(); ++i) {
    if (at(i).mode() == Mode::active) {
      return std::unexpected(SceneRefusal{.fault = SceneFault::active});
    }
    const ControllerConfig& device = at(i).config();
    const SceneFeel feel{.tool_radius_m = world.tool_radius_m,
                         .max_force_N = device.safety.max_force_N,
                         .walls = felt_walls(device.safety),
                         .needle = world.needle};
    if (const auto part = unless_allowed(
            device, first_uncertified(device.certificate, objects, world.effects, feel))) {
      return std::unexpected(
          SceneRefusal{.fault = SceneFault::uncertified, .part = *part, .device = i});
    }
  }
  const std::size_t standing = rendering::standing_units(objects, world);
  if (!leaves_room(standing, scene_.world.budget_units())) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::costly,
                                        .standing_units = standing,
                                        .budget_units = scene_.world.budget_units()});
  }
  if (!scene_.load(objects, world)) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::world});
  }
  return {};
}

}  // namespace tactus::firmware
