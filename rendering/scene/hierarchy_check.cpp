#include "rendering/scene/hierarchy_check.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

using Result = std::expected<void, SceneError>;

// Returns true if the box holds the box from `lower` to `upper`. It is written so that a NaN in a
// box fails.
bool holds(const BvhNode& box, const Float3& lower, const Float3& upper) {
  return box.lower.x <= lower.x && box.lower.y <= lower.y && box.lower.z <= lower.z &&
         box.upper.x >= upper.x && box.upper.y >= upper.y && box.upper.z >= upper.z;
}

// Returns true if the box's corners are numbers.
bool is_finite(const BvhNode& box) {
  return std::isfinite(box.lower.x) && std::isfinite(box.lower.y) && std::isfinite(box.lower.z) &&
         std::isfinite(box.upper.x) && std::isfinite(box.upper.y) && std::isfinite(box.upper.z);
}

// A walk through the whole hierarchy, left child first, which stops at the first fault.
class Walk {
 public:
  explicit Walk(const MeshView& mesh) : mesh_(mesh) {}

  // Walks from the root. At the end every triangle must have been listed and every node visited: a
  // node that is on no path would never be checked.
  Result run() {
    push(0, 1);
    while (open_count_ > 0) {
      const Place place = open_[--open_count_];
      ++visited_;
      const BvhNode& node = mesh_.nodes[place.node];
      const Result step = node.is_leaf() ? leaf(place.node, node) : inner(place, node);
      if (!step) {
        return step;
      }
    }
    if (listed_ != mesh_.triangles.size() || visited_ != mesh_.nodes.size()) {
      return fail(SceneFault::hierarchy_cover, visited_);
    }
    return {};
  }

 private:
  // A node that waits, and its level; the root is on level 1.
  struct Place {
    std::uint32_t node = 0;
    std::uint32_t level = 0;
  };

  void push(std::uint32_t node, std::uint32_t level) { open_[open_count_++] = {node, level}; }

  // Checks a leaf: its triangles are the next ones in order, and its box holds their vertices.
  Result leaf(std::size_t index, const BvhNode& node) {
    if (node.first != listed_ || node.triangle_count > mesh_.triangles.size() - listed_) {
      return fail(SceneFault::hierarchy_cover, index);
    }
    for (const TriangleIndices& triangle : mesh_.triangles.subspan(listed_, node.triangle_count)) {
      for (const std::uint32_t vertex : triangle) {
        const Float3& p = mesh_.vertices[vertex];
        if (!is_finite(node) || !holds(node, p, p)) {
          return fail(SceneFault::hierarchy_box, index);
        }
      }
    }
    listed_ += node.triangle_count;
    return {};
  }

  // Checks an inner node: it is not too deep, and its children are in range, after it and in its
  // box. Children after their parent make cycles impossible.
  Result inner(const Place& place, const BvhNode& node) {
    if (place.level == kMaxHierarchyDepth) {
      return fail(SceneFault::hierarchy_depth, place.node);
    }
    // The right child is the last one that has to be there; the sum must not wrap.
    if (node.first <= place.node || node.first >= mesh_.nodes.size() - 1) {
      return fail(SceneFault::hierarchy_child, place.node);
    }
    for (const std::uint32_t child : {node.first + 1, node.first}) {
      const BvhNode& below = mesh_.nodes[child];
      if (!is_finite(node) || !holds(node, below.lower, below.upper)) {
        return fail(SceneFault::hierarchy_box, place.node);
      }
      push(child, place.level + 1);
    }
    return {};
  }

  const MeshView& mesh_;
  // Depth first with the left child on top: at most one waiting sibling a level.
  std::array<Place, kMaxHierarchyDepth + 1> open_{};
  std::size_t open_count_ = 0;
  // The number of triangles that leaves have brought, and of nodes that were visited.
  std::size_t listed_ = 0;
  std::size_t visited_ = 0;  // nodes
};

}  // namespace

Result check_hierarchy(const MeshView& mesh) {
  return Walk(mesh).run();
}

}  // namespace tactus::rendering
