// Reads an effect of a scene image. SceneImage calls it for each of them.
#pragma once

#include <optional>

#include "rendering/effects/effect.h"

namespace tactus::rendering {

namespace image {
struct Effect;
}  // namespace image

// Returns the effect, or nothing if the law is unknown or not valid() (see
// rendering/effects/effect.h).
std::optional<Effect> read_effect(const image::Effect& stored);

}  // namespace tactus::rendering
