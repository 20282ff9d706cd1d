// Checks that the scene's device can render the friction of a surface without buzzing, and that the
// friction model gives out no energy. The baker calls it for every object; the theory is in
// rendering/friction/sampled_device.h and lugre_passivity.h.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// Throws InputError if the device of the scene cannot hold the friction's bristle as a stable
// spring under some normal force up to the largest. The message names the largest stiffness and
// damping that it can hold.
void require_stable_friction(const ObjectDescription& object, const SceneDescription& scene);

// Returns one line if the friction can give out energy, with what to change; nothing if it is
// passive.
std::vector<std::string> friction_warnings(const ObjectDescription& object,
                                           const SceneDescription& scene);

}  // namespace tactus::host
