// Makes the world's configuration, for one tool as in a controller, from a scene, and counts what
// the scene has.
#pragma once

#include "rendering/scene/scene_image.h"
#include "rendering/world/world.h"

namespace tactus::rendering {

// Returns the configuration; its spans live as long as the image.
inline WorldConfig world_of(const SceneImage& scene) {
  return {.tool_radius_m = scene.tool_radius_m(),
          .effects = scene.effects(),
          .bodies = scene.bodies(),
          .body_parts = scene.body_parts(),
          .gravity_W = scene.gravity_W(),
          .soft_finger_modulus_Pa = scene.soft_finger_modulus_Pa(),
          .sleep_after_s = scene.sleep_after_s(),
          .needle = scene.needle()};
}

// Returns what the scene has of each size of a profile.
inline SceneCounts scene_counts(const SceneImage& scene) {
  WorldConfig config = world_of(scene);
  config.tool_count = scene.tool_count();
  return scene_counts(scene.objects(), config);
}

}  // namespace tactus::rendering
