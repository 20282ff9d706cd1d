// Builds the bounding-volume hierarchy that the controller walks (rendering/objects/object.h has
// the node's layout).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

struct Hierarchy {
  std::vector<rendering::BvhNode> nodes;
  std::vector<std::uint32_t>
      order;  // order[i] is the old index of the triangle that now stands at place i
};

// Binned surface-area heuristic (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007), leaves of at most four triangles, at most rendering::kMaxHierarchyDepth
// levels. The result depends on the input alone. `triangles` must not be empty and its indices must
// lie within `vertices`.
Hierarchy build_hierarchy(std::span<const rendering::Float3> vertices,
                          std::span<const rendering::TriangleIndices> triangles);

}  // namespace tactus::host
