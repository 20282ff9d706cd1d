// Questions to a bounding-volume hierarchy. They have fixed stacks and no recursion. They are
// templates so that the visitor is inlined.
//
// A visitor gives the question its reach and takes the answers:
//
//   operator()(t)   is called with the index of each triangle in the leaves that are reached; or
//   leaf(node)      with each such leaf instead
//   reach()         returns the distance that counts, m; it may shrink while the walk goes on
//   boxes(pairs)    optional: is told how many pairs of boxes were looked at, for a budget
//   exhausted()     optional: returns true to end the walk
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "rendering/geometry/box_entry.h"
#include "rendering/geometry/hierarchy_walk.h"
#include "rendering/geometry/mesh.h"
#include "rendering/geometry/near_box.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// Returns a triangle of the mesh, in the mesh's frame, m.
inline Triangle triangle_of(const MeshView& mesh, std::uint32_t t) {
  const TriangleIndices& corners = mesh.triangles[t];
  return {to_vec3(mesh.vertices[corners[0]]), to_vec3(mesh.vertices[corners[1]]),
          to_vec3(mesh.vertices[corners[2]])};
}

// Returns the vector from the nearest point of the triangle's own box to p; frame of the mesh, m.
inline Vec3 offset_from_box(const MeshView& mesh, std::uint32_t t, const Vec3& p) {
  const TriangleIndices& corners = mesh.triangles[t];
  const Float3& a = mesh.vertices[corners[0]];
  const Float3& b = mesh.vertices[corners[1]];
  const Float3& c = mesh.vertices[corners[2]];
  const auto axis = [](float u, float v, float w, double x) {
    const auto lower = static_cast<double>(std::min({u, v, w}));
    const auto upper = static_cast<double>(std::max({u, v, w}));
    return std::max(x - upper, 0.0) - std::max(lower - x, 0.0);
  };
  return {axis(a.x, b.x, c.x, p.x()), axis(a.y, b.y, c.y, p.y()), axis(a.z, b.z, c.z, p.z())};
}

// Returns the squared distance from p to the node's box, m^2; 0 inside.
inline double squared_distance(const BvhNode& node, const Vec3& p) {
  const double x = std::max(
      {static_cast<double>(node.lower.x) - p.x(), 0.0, p.x() - static_cast<double>(node.upper.x)});
  const double y = std::max(
      {static_cast<double>(node.lower.y) - p.y(), 0.0, p.y() - static_cast<double>(node.upper.y)});
  const double z = std::max(
      {static_cast<double>(node.lower.z) - p.z(), 0.0, p.z() - static_cast<double>(node.upper.z)});
  return x * x + y * y + z * z;
}

// Visits every triangle whose leaf box comes within visitor.reach() of p. The nearer of two
// siblings comes first, so that a reach that shrinks soon rules out the rest.
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
    count_boxes(visitor, 1);
    fetch_below(nodes, nodes[node.first], nodes[node.first + 1]);
    Pending near{node.first, squared_distance(nodes[node.first], p)};
    Pending far{node.first + 1, squared_distance(nodes[node.first + 1], p)};
    if (far.squared < near.squared) {
      std::swap(near, far);
    }
    stack[depth++] = far;
    stack[depth++] = near;
  }
}

// Visits every triangle whose leaf box comes within `reach` of the box about p with the half sides
// `half`, in no order.
template <class Visitor>
void visit_all_near(std::span<const BvhNode> nodes, const Vec3& p, const Vec3& half, double reach,
                    Visitor&& visitor) {
  const NearBox box(p, half, reach);
  WalkLeft left;
  begin_walk(nodes, box, left);
  go_on_walking(nodes, box, left, visitor);
}

// Visits every triangle whose leaf box, grown by `margin`, is entered by the segment from `from`
// along the unit `direction` before visitor.reach(); nearer boxes first. The reach may shrink while
// the walk goes on. If the visitor says that it is exhausted(), the walk ends. Returns the travel
// up to which every triangle has been visited, m: infinity after a whole walk.
template <class Visitor>
double visit_along(std::span<const BvhNode> nodes, const Vec3& from, const Vec3& direction,
                   double margin, Visitor&& visitor) {
  struct Pending {
    std::uint32_t node;
    float entry;
  };
  if (nodes.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  const BoxEntry entry(from, direction, margin);
  std::array<Pending, kMaxHierarchyDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, entry.into(nodes[0], nodes[0], visitor.reach()).first};
  while (depth > 0) {
    const Pending pending = stack[--depth];
    if (!(static_cast<double>(pending.entry) <= visitor.reach())) {
      continue;
    }
    if constexpr (requires { visitor.exhausted(); }) {
      if (visitor.exhausted()) {
        // The nearest box that waits bounds what is known: no triangle before its entry is missing.
        float soonest = pending.entry;
        for (std::size_t i = 0; i < depth; ++i) {
          soonest = std::min(soonest, stack[i].entry);
        }
        return static_cast<double>(soonest);
      }
    }
    const BvhNode& node = nodes[pending.node];
    if (node.is_leaf()) {
      visit_leaf(node, visitor);
      continue;
    }
    count_boxes(visitor, 1);
    fetch_below(nodes, nodes[node.first], nodes[node.first + 1]);
    const BoxEntry::Pair entries =
        entry.into(nodes[node.first], nodes[node.first + 1], visitor.reach());
    Pending near{node.first, entries.first};
    Pending far{node.first + 1, entries.second};
    if (far.entry < near.entry) {
      std::swap(near, far);
    }
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace tactus::rendering
