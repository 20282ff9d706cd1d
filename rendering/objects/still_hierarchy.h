// A bounding-volume hierarchy over the boxes of the objects at rest. SceneObjects builds it once
// per scene. A query that searches all objects then costs the logarithm of their number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/objects/changed_objects.h"
#include "rendering/objects/object.h"

namespace tactus::rendering {

// Lives in static storage; no heap.
class StillHierarchy {
 public:
  // Builds the hierarchy over those of at most kMaxObjects `objects` that are at rest and, with
  // their changes, meet the shared proxy. It splits in halves along the longest side of the
  // centres' box, so its depth is the logarithm of their number.
  void build(std::span<const Object> objects, const ChangedObjects& changed);

  // Returns the nodes; none without objects. The "triangles" of a leaf are places of object().
  [[nodiscard]] std::span<const BvhNode> nodes() const { return {nodes_.data(), node_count_}; }
  // Returns the number of the object at a place.
  [[nodiscard]] std::uint32_t object(std::uint32_t place) const { return order_[place]; }

 private:
  // A node that waits to be built over a range of order_.
  struct Part {
    std::uint32_t node;
    std::uint32_t first;  // place of object()
    std::uint32_t count;
  };

  // Sets the node's box. Returns the axis along which the centres of its objects spread most.
  Eigen::Index enclose(std::span<const Object> objects, const Part& part);
  void halve(std::span<const Object> objects, const Part& part, Eigen::Index axis);

  std::array<BvhNode, 2 * kMaxObjects> nodes_{};
  std::size_t node_count_ = 0;
  // The numbers of the objects, in the order of the leaves.
  std::array<std::uint32_t, kMaxObjects> order_{};
};

}  // namespace tactus::rendering
