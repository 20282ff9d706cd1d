// What a controller is given before it ticks: a configuration and a scene.
#include <optional>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// What of a scene this configuration does not allow.
std::optional<UncertifiedPart> refused_part(const ControllerConfig& config,
                                            std::span<const rendering::Object> objects,
                                            std::span<const rendering::Effect> effects) {
  return config.allow_uncertified ? std::nullopt
                                  : first_uncertified(config.certificate, objects, effects);
}

}  // namespace

std::expected<void, ConfigError> Controller::configure(const ControllerConfig& config) {
  if (const auto valid = validate(config); !valid) {
    return valid;
  }
  if (const auto part = refused_part(config, objects_, effects_)) {
    return std::unexpected(
        ConfigError{"certificate", part->stiffness_N_per_m, 0.0, part->limit_N_per_m});
  }
  config_ = config;
  configured_safety_ = config.safety;
  change_ = ParameterChange{};
  mechanism_ = Mechanism(config.mechanism);
  sample_check_.configure(config);
  loop_check_.configure(config);
  encoder_guard_.configure(config);
  effort_guard_.configure(config);
  sign_check_.configure(config);
  workspace_walls_.configure(config);
  motion_guard_.configure(config);
  energy_.configure(config);
  passivity_.configure(config);
  velocity_filter_.configure(config.velocity_cutoff_hz, config.rate_hz);
  force_limiter_.configure(config);
  gravity_compensation_.configure(config);
  friction_compensation_.configure(config);
  material_changes_.finish(world_);
  world_.reset();
  world_.set_tick(1.0 / config.rate_hz);
  configured_ = true;

  mode_ = Mode::init;
  faults_ = kNoFault;
  fault_joint_ = 0;
  raised_ = kNoFault;
  write_status_ = drivers::kDeviceOk;
  loop_report_ = {};
  held_effort_ = {};
  pose_ = Pose{};
  tool_ = rendering::ToolState{};
  record_ = TelemetryRecord{};
  next_tick_ = 0;
  return {};
}

std::expected<void, SceneRefusal> Controller::load_scene(std::span<const rendering::Object> objects,
                                                         const rendering::WorldConfig& config) {
  if (mode_ == Mode::active) {
    return std::unexpected(SceneRefusal{SceneFault::active, {}});
  }
  if (const auto part = refused_part(config_, objects, config.effects)) {
    return std::unexpected(SceneRefusal{SceneFault::uncertified, *part});
  }
  material_changes_.clear();
  const bool taken = world_.set_scene(objects, config);
  objects_ = taken ? objects : std::span<const rendering::Object>{};
  effects_ = taken ? config.effects : std::span<const rendering::Effect>{};
  if (!taken) {
    return std::unexpected(SceneRefusal{SceneFault::world, {}});
  }
  return {};
}

}  // namespace tactus::firmware
