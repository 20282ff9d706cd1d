// Checks that a device can hold a surface's friction, and that the friction gives out no energy.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// Throws InputError where the scene's device cannot hold the bristle of the object's friction
// (rendering/friction/sampled_device.h) under every normal force up to its largest, with the
// largest stiffness and damping that it can.
void require_stable_friction(const ObjectDescription& object, const SceneDescription& scene);

// One line if the friction can give out energy, with what to change
// (rendering/friction/lugre_passivity.h).
std::vector<std::string> friction_warnings(const ObjectDescription& object,
                                           const SceneDescription& scene);

}  // namespace tactus::host
