// Controller::configure and Controller::load_scene.
#include <optional>

#include "firmware/control/controller.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// Returns a part of the scene that this configuration does not allow, or nothing.
std::optional<UncertifiedPart> refused_part(const ControllerConfig& config,
                                            const FeltScene& scene) {
  return config.allow_uncertified
             ? std::nullopt
             : first_uncertified(config.certificate, scene.objects, scene.effects, scene.feel);
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
  const WantedMaterials materials{.controller = this};
  if (const auto part = refused_part(config, felt_scene(materials, config.safety))) {
    return std::unexpected(uncertified_field(*part));
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
  const FeltScene scene{.objects = objects,
                        .effects = config.effects,
                        .feel = {.tool_radius_m = config.tool_radius_m,
                                 .max_force_N = configured_safety_.max_force_N,
                                 .walls = felt_walls(configured_safety_)}};
  if (const auto part = refused_part(config_, scene)) {
    return std::unexpected(SceneRefusal{SceneFault::uncertified, *part});
  }
  material_changes_.clear();
  // The world is empty after a refusal, so the controller forgets the objects as well.
  const bool taken = world_.set_scene(objects, config);
  objects_ = taken ? objects : std::span<const rendering::Object>{};
  effects_ = taken ? config.effects : std::span<const rendering::Effect>{};
  tool_radius_m_ = config.tool_radius_m;
  if (!taken) {
    return std::unexpected(SceneRefusal{SceneFault::world, {}});
  }
  return {};
}

}  // namespace tactus::firmware
