// A straight way, of which boxes and triangles are asked whether they stay far from all of it.
#pragma once

#include <algorithm>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

class StraightWay {
 public:
  // From the origin to `way`, which may be zero: what is asked counts from the way's start, m.
  explicit StraightWay(const Vec3& way)
      : way_(way), over_squared_(way.squaredNorm() > 0.0 ? 1.0 / way.squaredNorm() : 0.0) {}

  // From a box to the point of the way that is nearest to the box's middle.
  struct Gap {
    Vec3 offset = Vec3::Zero();  // zero where that point is in the box
    double squared = 0.0;
    double part = 0.0;  // of the way, up to that point
  };
  [[nodiscard]] Gap gap(const Vec3& lower, const Vec3& upper) const {
    Gap gap;
    gap.part = std::clamp(0.5 * (lower + upper).dot(way_) * over_squared_, 0.0, 1.0);
    const Vec3 q = gap.part * way_;
    gap.offset = (q - upper).cwiseMax(0.0) - (lower - q).cwiseMax(0.0);
    gap.squared = gap.offset.squaredNorm();
    return gap;
  }

  // Whether the box with that gap is farther than `reach` from all of the way: it lies behind the
  // plane across the gap, and the way's ends are where the way is nearest to that plane. It may be
  // farther even where this says no.
  [[nodiscard]] bool clears(const Gap& gap, double reach) const {
    const double slope = gap.offset.dot(way_);
    const double least = gap.squared + std::min(-gap.part * slope, (1.0 - gap.part) * slope);
    return least > 0.0 && least * least > reach * reach * gap.squared;
  }

  // How far all of the way stays, at least, from what lies behind the plane with the unit normal u
  // and the given offset.
  [[nodiscard]] double distance_from(const Vec3& u, double offset) const {
    return std::min(0.0, u.dot(way_)) - offset;
  }

 private:
  Vec3 way_;
  double over_squared_;
};

}  // namespace tactus::rendering
