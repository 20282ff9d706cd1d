// Tests whether the boxes of a hierarchy come near a place, two boxes at once and without a branch.
// The walk of hierarchy_walk.h uses it.
#pragma once

#include <cstdint>
#include <limits>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/mesh.h"

namespace tactus::rendering {

// A box about a point that is tested against the boxes of a hierarchy.
class NearBox {
 public:
  // The box about p (m) has the half sides `half`; `reach` is the distance, m, that counts as near.
  NearBox(const Vec3& p, const Vec3& half, double reach) {
    // The reach grows by the rounding to float.
    constexpr double kRounding = 4e-7;
    const double size = p.cwiseAbs().maxCoeff() + half.maxCoeff() + reach;
    const auto wide = static_cast<float>(reach + kRounding * size);
    squared_reach_ = wide * wide;
    for (int k = 0; k < 3; ++k) {
      lower_[k] = static_cast<float>(p[k] - half[k]);
      upper_[k] = static_cast<float>(p[k] + half[k]);
    }
  }

  // Returns true if the node's box comes within reach. Rounding only adds boxes.
  [[nodiscard]] bool near(const BvhNode& node) const {
    const Floats squared = squared_gaps(node);
    return squared[0] + squared[2] + squared[1] <= squared_reach_;
  }

  // The answers for two nodes: 1 if the node is near, else 0.
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
    const std::uint32_t near = which(squared <= all(squared_reach_));
    return {near & 1U, near >> 1U & 1U};
  }

 private:
  // Returns the squared gaps between the two boxes along each axis, m^2, 0 where they overlap; the
  // last lane is 0.
  [[nodiscard]] Floats squared_gaps(const BvhNode& node) const {
    const Floats gap =
        most(most(floats_at(&node.lower.x) - upper_, lower_ - floats_at(&node.upper.x)), Floats{});
    return gap * gap;
  }

  // In memory an integer stands beside each corner of a node, and is loaded with it as a fourth
  // float: whatever it is, this box reaches past it.
  Floats lower_{0.0F, 0.0F, 0.0F, -std::numeric_limits<float>::infinity()};
  Floats upper_{0.0F, 0.0F, 0.0F, std::numeric_limits<float>::infinity()};
  float squared_reach_ = 0.0F;
};

}  // namespace tactus::rendering
