#include "firmware/control/loaded_scene.h"

#include <cmath>

#include "firmware/safety/workspace_walls.h"
#include "rendering/material/friction_exchange.h"

namespace tactus::firmware {
namespace {

// The objects of a scene after all changes, and a further change of `object` if `changed` is not
// null.
struct WantedObjects {
  const LoadedScene& scene;
  const rendering::Material* changed = nullptr;
  rendering::ContactMethod method{};
  std::uint32_t object = 0;

  [[nodiscard]] bool changes(std::uint32_t number) const {
    return changed != nullptr && number == object;
  }
};

rendering::Material wanted_material(const void* context, std::uint32_t object) {
  const auto& wanted = *static_cast<const WantedObjects*>(context);
  return wanted.changes(object) ? *wanted.changed : wanted.scene.wanted(object);
}

rendering::ContactMethod wanted_method(const void* context, std::uint32_t object) {
  const auto& wanted = *static_cast<const WantedObjects*>(context);
  return wanted.changes(object) ? wanted.method : wanted.scene.world.object(object).method;
}

// Returns the scene as the certificate sees it. `wanted` must outlive the result.
FeltScene felt_scene(const WantedObjects& wanted, const SafetyConfig& safety) {
  const LoadedScene& scene = wanted.scene;
  return {.objects = scene.objects,
          .effects = scene.effects,
          .feel = {.tool_radius_m = scene.tool_radius_m,
                   .max_force_N = safety.max_force_N,
                   .material = wanted_material,
                   .method = wanted_method,
                   .context = &wanted,
                   .walls = felt_walls(safety),
                   .needle = scene.needle}};
}

}  // namespace

void LoadedScene::restart(double tick_s, double tick_instructions) {
  complete_changes();
  world.reset();
  world.set_tick(tick_s);
  world.set_tick_budget(tick_instructions);
}

bool LoadedScene::load(std::span<const rendering::Object> loaded,
                       const rendering::WorldConfig& config) {
  changes.clear();
  // The world is empty after a refusal, so the scene forgets the objects as well.
  const bool taken = world.set_scene(loaded, config);
  objects = taken ? loaded : std::span<const rendering::Object>{};
  effects = taken ? config.effects : std::span<const rendering::Effect>{};
  needle = taken ? config.needle : rendering::NeedleScene{};
  tool_radius_m = config.tool_radius_m;
  standing_units = taken ? rendering::standing_units(loaded, config) : 0;
  return taken;
}

rendering::Material LoadedScene::wanted(std::uint32_t object) const {
  return changes.wanted(world, object);
}

rendering::Material LoadedScene::with_model(std::uint32_t object,
                                            rendering::FrictionKind kind) const {
  return rendering::with_friction_model(wanted(object), world.unchanged_object(object).material,
                                        kind);
}

bool LoadedScene::change_material(std::uint32_t object, const rendering::Material& material) {
  // The present material is set as a changed one first; the ticks then apply the change gradually.
  const rendering::Material felt = world.material(object);
  if (!world.set_material(object, felt)) {
    return false;
  }
  changes.set(object, material);
  return true;
}

bool LoadedScene::exchange_material(std::uint32_t object, const rendering::Material& material) {
  if (!world.set_material(object, material)) {
    return false;
  }
  changes.forget(object);
  return true;
}

std::optional<UncertifiedPart> LoadedScene::first_refused(const StiffnessCertificate& certificate,
                                                          const SafetyConfig& safety) const {
  const WantedObjects wanted{.scene = *this};
  const FeltScene felt = felt_scene(wanted, safety);
  return first_uncertified(certificate, felt.objects, felt.effects, felt.feel);
}

bool LoadedScene::is_certified(const StiffnessCertificate& certificate, const SafetyConfig& safety,
                               std::uint32_t object, const rendering::Material& material,
                               rendering::ContactMethod method) {
  const WantedObjects wanted{
      .scene = *this, .changed = &material, .method = method, .object = object};
  const auto part = uncertified_with(certificate, felt_scene(wanted, safety), object);
  refused_part = part.value_or(refused_part);
  return !part;
}

bool LoadedScene::advance_changes(double most_N, double speed_m_per_s) {
  changes.step(world, most_N, speed_m_per_s);
  return changes.any();
}

rendering::Touch free_touch(const rendering::ToolState& tool) {
  rendering::Touch touch;
  touch.proxy_W = tool.p_W;
  return touch;
}

bool is_finite(const rendering::Touch& touch) {
  const rendering::ForceParts& parts = touch.parts;
  return touch.force_W.allFinite() && touch.proxy_W.allFinite() && touch.normal_W.allFinite() &&
         std::isfinite(touch.depth_m) && parts.friction_W.allFinite() &&
         parts.texture_W.allFinite() && parts.effect_W.allFinite() &&
         std::isfinite(parts.driven_power);
}

}  // namespace tactus::firmware
