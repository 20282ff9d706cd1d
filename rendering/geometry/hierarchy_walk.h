// A walk to all leaves of a hierarchy that come near a place, which can be left and taken up again.
// The gathering of candidates walks in this manner, over several ticks in a dense place
// (rendering/contact/candidate_set_gather.cpp).
//
// A hierarchy of a large mesh lies in memory that is not in a cache, so the time of a walk is the
// time until its boxes arrive. The walk therefore goes breadth first: the next boxes are known, and
// prefetched, long before their turn.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/near_box.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// Tells a visitor that counts them how many pairs of boxes were looked at.
template <class Visitor>
void count_boxes(Visitor& visitor, std::uint32_t pairs) {
  if constexpr (requires { visitor.boxes(pairs); }) {
    visitor.boxes(pairs);
  }
}

// Gives a leaf to the visitor: whole to one that has leaf(), else triangle by triangle.
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

// Prefetches the children of two nodes. A leaf has no children: its address is read by nobody and
// may lie outside the array, so it is computed in bytes.
inline void fetch_below(std::span<const BvhNode> nodes, const BvhNode& first,
                        const BvhNode& second) {
  const auto start = std::bit_cast<std::uintptr_t>(nodes.data());
  __builtin_prefetch(std::bit_cast<const void*>(start + first.first * sizeof(BvhNode)));
  __builtin_prefetch(std::bit_cast<const void*>(start + second.first * sizeof(BvhNode)));
}

// The nodes that a walk has still to look at, in a ring. The first comes first, so that the next
// ones are known long before their turn, and while one waits for memory the others go on. With more
// than kRoomy waiting the last comes first, which adds no more than one a level.
struct WalkLeft {
  static constexpr std::uint32_t kRoomy = 128;
  // The leaves that are visited together: their triangles are looked at in one go.
  static constexpr std::uint32_t kLeaves = 32;
  // The most nodes that a walk leaves: those before it turned depth first, one a level, the leaves
  // found.
  static constexpr std::uint32_t kMostLeft = kRoomy + kMaxHierarchyDepth + kLeaves + 2;
  // The ring's places, a power of two. A walk may begin with all that one can leave.
  static constexpr std::uint32_t kPlaces = 512;
  static_assert(kMostLeft + kMaxHierarchyDepth + kLeaves + 2 <= kPlaces);

  std::array<std::uint32_t, kPlaces> nodes;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  // Returns the number of nodes that are left.
  [[nodiscard]] std::uint32_t count() const { return end - begin; }
  // Returns the node at a place of the ring; places only grow, and wrap round in at().
  [[nodiscard]] std::uint32_t& at(std::uint32_t place) { return nodes[place % kPlaces]; }
  void clear() { begin = end = 0; }
  void add(std::uint32_t node) { at(end++) = node; }
};

// Begins a walk at the root, if the box comes near it.
inline void begin_walk(std::span<const BvhNode> nodes, const NearBox& box, WalkLeft& left) {
  left.clear();
  if (!nodes.empty() && box.near(nodes[0])) {
    left.add(0);
  }
}

// The number of leaves found, and of the pairs of boxes that were looked at for them.
struct LeavesFound {
  std::uint32_t leaves = 0;
  std::uint32_t pairs = 0;  // of boxes that were looked at
};

// Takes nodes from what is left until kLeaves leaves that are near, or all of them, are found.
inline LeavesFound find_leaves(std::span<const BvhNode> nodes, const NearBox& box, WalkLeft& left,
                               std::span<std::uint32_t, WalkLeft::kLeaves + 2> leaves) {
  std::uint32_t found = 0;
  std::uint32_t pairs = 0;
  std::uint32_t begin = left.begin;
  std::uint32_t end = left.end;
  while (begin != end && found < WalkLeft::kLeaves) {
    const std::uint32_t number = left.at(end - begin > WalkLeft::kRoomy ? --end : begin++);
    const BvhNode& node = nodes[number];
    // The root may be a leaf, and a walk that was left may have put leaves back.
    if (node.is_leaf()) {
      leaves[found++] = number;
      continue;
    }
    // Which of the two is near, and which is a leaf, nobody can predict: both are written to both
    // lists, and what is not wanted there is written over. A leaf has no children, and what it
    // prefetches is not looked at.
    ++pairs;
    const BvhNode& first = nodes[node.first];
    const BvhNode& second = nodes[node.first + 1];
    fetch_below(nodes, first, second);
    const NearBox::Pair near = box.near(first, second);
    const std::uint32_t first_leaf = near.first & (first.is_leaf() ? 1U : 0U);
    const std::uint32_t second_leaf = near.second & (second.is_leaf() ? 1U : 0U);
    left.at(end) = leaves[found] = node.first;
    end += near.first - first_leaf;
    found += first_leaf;
    left.at(end) = leaves[found] = node.first + 1;
    end += near.second - second_leaf;
    found += second_leaf;
  }
  left.begin = begin;
  left.end = end;
  return {.leaves = found, .pairs = pairs};
}

// Visits every triangle whose leaf comes near the box, in no order. If the visitor says after a
// leaf that it is exhausted(), the walk stops and can go on later from what is left.
template <class Visitor>
void go_on_walking(std::span<const BvhNode> nodes, const NearBox& box, WalkLeft& left,
                   Visitor&& visitor) {
  std::array<std::uint32_t, WalkLeft::kLeaves + 2> leaves;
  while (left.count() > 0) {
    const LeavesFound found = find_leaves(nodes, box, left, leaves);
    count_boxes(visitor, found.pairs);
    for (std::uint32_t i = 0; i < found.leaves; ++i) {
      visit_leaf(nodes[leaves[i]], visitor);
      if constexpr (requires { visitor.exhausted(); }) {
        if (visitor.exhausted()) {
          while (++i < found.leaves) {
            left.add(leaves[i]);
          }
          return;
        }
      }
    }
  }
}

}  // namespace tactus::rendering
