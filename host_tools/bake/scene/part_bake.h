// Makes the convex parts of bodies.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host_tools/bake/scene/body_bake.h"
#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// Throws InputError if the bodies of the scene have more parts than kMaxBodyParts, or a part's mesh
// file is missing.
void check_parts(const SceneDescription& description);

// Returns the parts of the body of an object with this name. Adds to `warnings` where a hull leaves
// out vertices of its mesh. Throws InputError with the file, also for a part without volume;
// `scene` is the scene's.
std::vector<BakedPart> bake_parts(std::span<const PartDescription> descriptions,
                                  const std::string& object, const std::string& scene,
                                  std::vector<std::string>& warnings);

}  // namespace tactus::host
