// Checks whether an object has a size and a place that a hand can reach. The baker uses it.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// Objects longer than the first or shorter than the second are a mistake about the unit.
inline constexpr double kLongestObject_m = 10.0;
inline constexpr double kShortestObject_m = 0.001;

// Returns a warning, with the line to write, for a mesh of absurd size and for an object that
// reaches out of the world. `mesh` is the object's, or its picture.
std::vector<std::string> size_warnings(const ObjectDescription& object, const BakedMesh& mesh);

}  // namespace tactus::host
