// Walks over a bounding-volume hierarchy. Fixed stacks, no recursion; a visitor is called with the
// index of each triangle in the leaves that the query reaches, or its leaf() with each such leaf.
// (Templates so that the visitor is inlined.)
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"
#include "rendering/surface/mesh.h"

namespace tactus::rendering {

inline Triangle triangle_of(const MeshView& mesh, std::uint32_t t) {
  const TriangleIndices& corners = mesh.triangles[t];
  return {to_vec3(mesh.vertices[corners[0]]), to_vec3(mesh.vertices[corners[1]]),
          to_vec3(mesh.vertices[corners[2]])};
}

// Squared distance from p to the node's box, 0 inside.
inline double squared_distance(const BvhNode& node, const Vec3& p) {
  const double x = std::max(
      {static_cast<double>(node.lower.x) - p.x(), 0.0, p.x() - static_cast<double>(node.upper.x)});
  const double y = std::max(
      {static_cast<double>(node.lower.y) - p.y(), 0.0, p.y() - static_cast<double>(node.upper.y)});
  const double z = std::max(
      {static_cast<double>(node.lower.z) - p.z(), 0.0, p.z() - static_cast<double>(node.upper.z)});
  return x * x + y * y + z * z;
}

// 1 / direction for `entry_travel`, finite in every component.
Vec3 slab_inverse(const Vec3& direction);

// Travel at which the segment enters the node's box grown by `margin`, or infinity if it does not
// within `limit`.
double entry_travel(const BvhNode& node, const Vec3& from, const Vec3& inverse_direction,
                    double margin, double limit);

template <class Visitor>
void visit_leaf(const BvhNode& leaf, Visitor& visitor) {
  if constexpr (requires { visitor.leaf(leaf); }) {
    visitor.leaf(leaf);
  } else {
    for (std::uint32_t t = leaf.first; t < leaf.first + leaf.triangle_count; ++t) {
      visitor(t);
    }
  }
}

// A box about a point, of which the boxes of a hierarchy are asked whether they come near.
class NearBox {
 public:
  // `half` are the half sides of the box about p.
  NearBox(const Vec3& p, const Vec3& half, double reach) {
    // What rounding to float takes off is given to the reach.
    constexpr double kRounding = 4e-7;
    const double size = p.cwiseAbs().maxCoeff() + half.maxCoeff() + reach;
    const auto wide = static_cast<float>(reach + kRounding * size);
    squared_reach_ = wide * wide;
    for (int k = 0; k < 3; ++k) {
      lower_[k] = static_cast<float>(p[k] - half[k]);
      upper_[k] = static_cast<float>(p[k] + half[k]);
    }
  }

  [[nodiscard]] bool near(const BvhNode& node) const {
    const Floats squared = squared_gaps(node);
    return squared[0] + squared[2] + squared[1] <= squared_reach_;
  }

  // The same of two nodes: 1 for one that is near, else 0.
  struct Pair {
    std::uint32_t first;
    std::uint32_t second;
  };
  [[nodiscard]] Pair near(const BvhNode& first, const BvhNode& second) const {
    const Floats a = squared_gaps(first);
    const Floats b = squared_gaps(second);
    const Floats sum =
        __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Floats squared = sum + __builtin_shufflevector(sum, sum, 2, 3, 2, 3);
    return {squared[0] <= squared_reach_ ? 1U : 0U, squared[1] <= squared_reach_ ? 1U : 0U};
  }

 private:
  // Along each axis; the last is 0.
  [[nodiscard]] Floats squared_gaps(const BvhNode& node) const {
    // Beside the corners stand integers.
    constexpr Integers kThree{-1, -1, -1, 0};
    const auto node_lower = std::bit_cast<Floats>(bits_at(&node.lower) & kThree);
    const auto node_upper = std::bit_cast<Floats>(bits_at(&node.upper) & kThree);
    const Floats gap = most(most(node_lower - upper_, lower_ - node_upper), Floats{});
    return gap * gap;
  }

  static Integers bits_at(const Float3* corner) {
    Integers bits;
    std::memcpy(&bits, corner, sizeof bits);
    return bits;
  }

  Floats lower_{};
  Floats upper_{};
  float squared_reach_ = 0.0F;
};
static_assert(offsetof(BvhNode, first) == sizeof(Float3) &&
              offsetof(BvhNode, triangle_count) == 16 + sizeof(Float3));

// Every triangle whose leaf box comes within visitor.reach() of p, nearer boxes first where that is
// free to know. The reach may shrink while the walk goes on.
template <class Visitor>
void visit_near(std::span<const BvhNode> nodes, const Vec3& p, Visitor&& visitor) {
  struct Pending {
    std::uint32_t node;
    double squared;
  };
  if (nodes.empty()) {
    return;
  }
  std::array<Pending, kMaxHierarchyDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, squared_distance(nodes[0], p)};
  while (depth > 0) {
    const Pending pending = stack[--depth];
    if (pending.squared > visitor.reach() * visitor.reach()) {
      continue;
    }
    const BvhNode& node = nodes[pending.node];
    if (node.is_leaf()) {
      visit_leaf(node, visitor);
      continue;
    }
    Pending near{node.first, squared_distance(nodes[node.first], p)};
    Pending far{node.first + 1, squared_distance(nodes[node.first + 1], p)};
    if (far.squared < near.squared) {
      std::swap(near, far);
    }
    stack[depth++] = far;
    stack[depth++] = near;
  }
}

// What is left of a walk: the nodes still to be looked at, the last one next. There is room for a
// walk that begins with as many nodes as one can leave.
struct WalkLeft {
  static constexpr std::size_t kMostLeft = kMaxHierarchyDepth + 2;
  std::array<std::uint32_t, 2 * kMostLeft> nodes;
  std::size_t count = 0;
};

inline void begin_walk(std::span<const BvhNode> nodes, const NearBox& box, WalkLeft& left) {
  left.count = 0;
  if (!nodes.empty() && box.near(nodes[0])) {
    left.nodes[left.count++] = 0;
  }
}

// Every triangle whose leaf comes near the box, in no order. Where the visitor says after a leaf
// that it is exhausted(), the walk stops and can go on later from what is left.
template <class Visitor>
void go_on_walking(std::span<const BvhNode> nodes, const NearBox& box, WalkLeft& left,
                   Visitor&& visitor) {
  std::size_t depth = left.count;
  while (depth > 0) {
    const BvhNode& node = nodes[left.nodes[--depth]];
    if (node.is_leaf()) {
      visit_leaf(node, visitor);
      if constexpr (requires { visitor.exhausted(); }) {
        if (visitor.exhausted()) {
          break;
        }
      }
      continue;
    }
    // Which of the two is near nobody can predict: both are written, and those that are not near
    // written over.
    const NearBox::Pair near = box.near(nodes[node.first], nodes[node.first + 1]);
    left.nodes[depth] = node.first;
    depth += near.first;
    left.nodes[depth] = node.first + 1;
    depth += near.second;
  }
  left.count = depth;
}

// Every triangle whose leaf box comes within the reach of the box about p with the half sides
// `half`, in no order.
template <class Visitor>
void visit_all_near(std::span<const BvhNode> nodes, const Vec3& p, const Vec3& half, double reach,
                    Visitor&& visitor) {
  const NearBox box(p, half, reach);
  WalkLeft left;
  begin_walk(nodes, box, left);
  go_on_walking(nodes, box, left, visitor);
}

// Every triangle whose leaf box, grown by `margin`, the segment from `from` along the unit
// `direction` enters before visitor.reach(); nearer boxes first. The reach may shrink while the
// walk goes on. Where the visitor says that it is exhausted(), the walk ends; returned is the
// travel up to which every triangle has been visited, infinity after a whole walk.
template <class Visitor>
double visit_along(std::span<const BvhNode> nodes, const Vec3& from, const Vec3& direction,
                   double margin, Visitor&& visitor) {
  struct Pending {
    std::uint32_t node;
    double entry;
  };
  if (nodes.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  const Vec3 inverse = slab_inverse(direction);
  std::array<Pending, kMaxHierarchyDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, entry_travel(nodes[0], from, inverse, margin, visitor.reach())};
  while (depth > 0) {
    const Pending pending = stack[--depth];
    if (!(pending.entry <= visitor.reach())) {
      continue;
    }
    if constexpr (requires { visitor.exhausted(); }) {
      if (visitor.exhausted()) {
        double entry = pending.entry;
        for (std::size_t i = 0; i < depth; ++i) {
          entry = std::min(entry, stack[i].entry);
        }
        return entry;
      }
    }
    const BvhNode& node = nodes[pending.node];
    if (node.is_leaf()) {
      visit_leaf(node, visitor);
      continue;
    }
    Pending near{node.first,
                 entry_travel(nodes[node.first], from, inverse, margin, visitor.reach())};
    Pending far{node.first + 1,
                entry_travel(nodes[node.first + 1], from, inverse, margin, visitor.reach())};
    if (far.entry < near.entry) {
      std::swap(near, far);
    }
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace tactus::rendering
