// Proves that a hierarchy can be walked without any check of its own. The walks of
// rendering/geometry/hierarchy_query.h rest on it: they have stacks of a fixed size and read what
// the nodes name.
#pragma once

#include <expected>

#include "rendering/objects/object.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

// Returns an error unless all of this holds: children stand after their parent and in range; no
// path is longer than kMaxHierarchyDepth; walked left child first, the leaves list every triangle
// once and in order; every node is on a path; every box is finite and holds its children's boxes or
// its triangles' vertices. Errors: the hierarchy_ faults, with the node as the place.
//
// Needs finite vertices, vertex indices in range, at least one triangle and one node. Ends after at
// most 2 x triangles steps on any input, because every leaf must bring the next triangles.
std::expected<void, SceneError> check_hierarchy(const MeshView& mesh);

}  // namespace tactus::rendering
