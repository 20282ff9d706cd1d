// The contacts of two solids of several parts: parts that meet along one plane share a contact.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rendering/bodies/manifold.h"

namespace tactus::rendering {

// Joins manifolds whose normals agree, so that a solid of several parts has the contact points that
// the solid of one part would have. Lives in static storage; no heap.
class JoinedManifolds {
 public:
  // The most normals of two solids. Beyond: the last ones are left out.
  static constexpr std::size_t kMostNormals = 32;

  void clear() {
    count_ = 0;
    left_out_ = false;
  }
  // Adds a manifold, joined with one of the same normal. Points that are there already are not
  // added again.
  void add(const Manifold& manifold);
  // Adds a manifold as it is; one without points is left out.
  void append(const Manifold& manifold);

  // Returns the manifolds, in the order in which their normals were found. Each has the normal of
  // the part that is deepest, and of all its points those that hold a body best.
  [[nodiscard]] std::span<const Manifold> all() const { return {manifolds_.data(), count_}; }
  // Returns true if there were more than kMostNormals.
  [[nodiscard]] bool has_left_out() const { return left_out_; }

 private:
  std::array<Manifold, kMostNormals> manifolds_;
  std::size_t count_ = 0;
  bool left_out_ = false;
};

}  // namespace tactus::rendering
