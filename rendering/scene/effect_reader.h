// Reads an effect of a scene image. SceneImage calls it for each of them.
#pragma once

#include <expected>

#include "rendering/effects/effect.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

namespace image {
struct Effect;
}  // namespace image

// Returns the effect, or SceneFault::effect_law with the name of a law that is not registered, or
// SceneFault::effect if it is not valid(). The error's place is left to the caller.
std::expected<Effect, SceneError> read_effect(const image::Effect& stored);

}  // namespace tactus::rendering
