// The loaded scene: the world that the tool touches, the changes of its materials that are not
// complete, and its check against the certificate. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/configuration/controller_config.h"
#include "firmware/control/material_changes.h"
#include "firmware/safety/certificate.h"
#include "rendering/material/material.h"
#include "rendering/touch.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

// A scene with its world. The members are public because the state saves the world and the changes
// in the order of its format.
struct LoadedScene {
  // Has room for one tool and for those of `more_tools` (World::World).
  explicit LoadedScene(std::span<rendering::ToolSlot> more_tools = {}) : world(more_tools) {}

  // Completes all changes of materials and frees the tool of all contact. `tick_s` is the time from
  // tick to tick, and `tick_instructions` is what a tick of the world may take.
  void restart(double tick_s, double tick_instructions);

  // Loads a scene; the memory behind the objects must outlive it. Returns false if the world
  // refuses it; the scene is then empty.
  bool load(std::span<const rendering::Object> loaded, const rendering::WorldConfig& config);

  // Returns the material that the object has after all changes.
  [[nodiscard]] rendering::Material wanted(std::uint32_t object) const;
  // Returns that material with another friction model (rendering/material/friction_exchange.h).
  [[nodiscard]] rendering::Material with_model(std::uint32_t object,
                                               rendering::FrictionKind kind) const;
  // Begins the change to another material. Returns false if too many objects have been changed.
  bool change_material(std::uint32_t object, const rendering::Material& material);
  // Changes to another material at once, for an object that no tool touches. Returns false if too
  // many objects have been changed.
  bool exchange_material(std::uint32_t object, const rendering::Material& material);

  // Returns the first part that the certificate does not allow, or nothing. `safety` has the walls
  // of the workspace, which push together with the scene.
  [[nodiscard]] std::optional<UncertifiedPart> first_refused(
      const StiffnessCertificate& certificate, const SafetyConfig& safety) const;
  // Returns true if the certificate allows the object with that material and method. Otherwise sets
  // refused_part.
  bool is_certified(const StiffnessCertificate& certificate, const SafetyConfig& safety,
                    std::uint32_t object, const rendering::Material& material,
                    rendering::ContactMethod method);

  // Advances the changes of materials by one tick in which the force may change by at most
  // `most_N`. Returns true if some are not complete. Real time.
  bool advance_changes(double most_N, double speed_m_per_s);
  // Completes the changes of materials at once, in a tick without force. Real time.
  void complete_changes() { changes.finish(world); }

  rendering::World world;
  MaterialChanges changes;
  // The objects and effects of the scene, and its needle.
  std::span<const rendering::Object> objects;
  std::span<const rendering::Effect> effects;
  rendering::NeedleScene needle;
  double tool_radius_m = 0.0;
  // The cost units that its motions and effects take in every tick (rendering/tick_budget.h).
  std::size_t standing_units = 0;
  // The part that is_certified() refused last.
  UncertifiedPart refused_part;
};

// Returns the touch of a tool that touches nothing.
rendering::Touch free_touch(const rendering::ToolState& tool);

// Returns true if all numbers of the touch are finite.
bool is_finite(const rendering::Touch& touch);

}  // namespace tactus::firmware
