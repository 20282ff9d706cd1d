// Makes the world's configuration, for one tool as in a controller, from a scene.
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

}  // namespace tactus::rendering
