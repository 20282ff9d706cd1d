// Counts what an image has, before anything of it is taken into an array.
#pragma once

#include "rendering/profiles/scene_capacity.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::rendering {

// Returns the counts of all that SceneImage keeps in an array; the others are 0.
SceneCounts stored_counts(const image::Scene& scene);

}  // namespace tactus::rendering
