// Builds the bounding-volume hierarchy of a mesh, which the controller's contact search walks every
// tick. The baker calls it once a mesh, and so do tests and benchmarks that make their own meshes;
// rendering/geometry/mesh.h describes the node's layout.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

struct Hierarchy {
  // The nodes, root first. The two children of an inner node stand side by side.
  std::vector<rendering::BvhNode> nodes;
  // The triangles in the order in which the leaves refer to them: order[i] is the index, in the
  // caller's list, of the triangle that now stands at place i.
  std::vector<std::uint32_t> order;
};

// Returns a hierarchy by the binned surface-area heuristic (Wald, "On fast construction of
// SAH-based bounding volume hierarchies", 2007). Leaves have at most four triangles, and there are
// at most rendering::kMaxHierarchyDepth levels, so that the controller's stack suffices. The result
// depends on the input alone. `triangles` must not be empty and its indices must lie within
// `vertices`.
Hierarchy build_hierarchy(std::span<const rendering::Float3> vertices,
                          std::span<const rendering::TriangleIndices> triangles);

}  // namespace tactus::host
