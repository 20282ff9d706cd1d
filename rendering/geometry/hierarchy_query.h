// Walks over a bounding-volume hierarchy. Fixed stacks, no recursion; a visitor is called with the
// index of each triangle in the leaves that the query reaches. (Templates so that the visitor is
// inlined.)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
  for (std::uint32_t t = leaf.first; t < leaf.first + leaf.triangle_count; ++t) {
    visitor(t);
  }
}

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
