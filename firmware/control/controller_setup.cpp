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

std::expected<void, ConfigError> Controller::configure(const ControllerConfig& config) {
  if (const auto valid = validate(config); !valid) {
    return valid;
  }
  if (const auto part =
          unless_allowed(config, scene_.first_refused(config.certificate, config.safety))) {
    return std::unexpected(uncertified_field(*part));
  }
  const double budget = tick_instructions(config);
  if (!leaves_room(scene_.standing_units, rendering::units_of(budget))) {
    return std::unexpected(ConfigError{"tick_instructions", budget,
                                       2.0 * rendering::instructions_of(scene_.standing_units),
                                       std::numeric_limits<double>::infinity()});
  }
  settings_ = {.config = config, .configured_safety = config.safety, .is_configured = true};
  next_ = NextTick{};
  modes_.configure(config.safety.guards_off);
  guards_.configure(config);
  locator_.configure(config);
  scene_.restart(1.0 / config.rate_hz, budget);
  force_path_.configure(config);
  effort_path_.configure(config);
  record_ = TelemetryRecord{};
  return {};
}

std::expected<void, SceneRefusal> Controller::load_scene(std::span<const rendering::Object> objects,
                                                         const rendering::WorldConfig& config) {
  if (modes_.mode() == Mode::active) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::active});
  }
  const auto& [device, safety, is_configured] = settings_;
  const SceneFeel feel{.tool_radius_m = config.tool_radius_m,
                       .max_force_N = safety.max_force_N,
                       .walls = felt_walls(safety)};
  if (const auto part = unless_allowed(
          device, first_uncertified(device.certificate, objects, config.effects, feel))) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::uncertified, .part = *part});
  }
  const std::size_t standing = rendering::standing_units(objects, config);
  if (!leaves_room(standing, scene_.world.budget_units())) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::costly,
                                        .standing_units = standing,
                                        .budget_units = scene_.world.budget_units()});
  }
  if (!scene_.load(objects, config)) {
    return std::unexpected(SceneRefusal{.fault = SceneFault::world});
  }
  return {};
}

}  // namespace tactus::firmware
