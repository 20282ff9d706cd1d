// Finds where a ray enters the boxes of a hierarchy, two boxes at once: the slab method (Kay and
// Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986) in the lanes of a vector. visit_along() of
// hierarchy_query.h uses it.
#pragma once

#include <limits>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/mesh.h"

namespace tactus::rendering {

// A ray that is tested against the boxes of a hierarchy. Everything is rounded so that no box that
// the exact ray enters is missed.
class BoxEntry {
 public:
  // The ray starts at `from` along a unit direction; boxes are grown by the margin, m.
  BoxEntry(const Vec3& from, const Vec3& direction, double margin);

  // The travel, in metres, at which the ray enters each of two boxes, or infinity if that is beyond
  // the limit. It is never later than the exact value.
  struct Pair {
    float first;
    float second;
  };
  [[nodiscard]] Pair into(const BvhNode& first, const BvhNode& second, double limit) const {
    const Slabs a = slabs(first);
    const Slabs b = slabs(second);
    // Rounding may have made the entry late or the exit early; both are moved past it.
    constexpr float kRounding = 1e-6F;
    const Floats enter = (1.0F - kRounding) * most(transposed(a.near, b.near, most), Floats{});
    const Floats leave = least((1.0F + kRounding) * transposed(a.far, b.far, least),
                               all((1.0F + kRounding) * static_cast<float>(limit)));
    const Floats travel = enter <= leave ? enter : all(std::numeric_limits<float>::infinity());
    return {travel[0], travel[1]};
  }

 private:
  // The travels at which the ray is between the two planes of each axis, m.
  struct Slabs {
    Floats near;
    Floats far;
  };
  // Returns the entry and exit along each axis; the fourth lane is no travel.
  [[nodiscard]] Slabs slabs(const BvhNode& node) const {
    const Floats lower = (floats_at(&node.lower.x) - from_upper_) * inverse_;
    const Floats upper = (floats_at(&node.upper.x) - from_lower_) * inverse_;
    return {least(lower, upper), most(lower, upper)};
  }
  // Combines the first three lanes of each with `best`, into the first two lanes.
  template <class Best>
  static Floats transposed(Floats a, Floats b, Best best) {
    const Floats xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Floats z = __builtin_shufflevector(a, b, 2, 6, 2, 6);
    return best(best(xy, z), __builtin_shufflevector(xy, xy, 2, 3, 2, 3));
  }

  // The start of the ray, less and plus the margin, and the inverse of its direction.
  // The start of the ray, less and plus the margin, and the inverse of its direction.
  Floats from_lower_{};
  Floats from_upper_{};
  Floats inverse_{};
};

}  // namespace tactus::rendering
