#include "rendering/geometry/box_entry.h"

#include <cmath>

namespace tactus::rendering {

BoxEntry::BoxEntry(const Vec3& from, const Vec3& direction, double margin) {
  // The margin grows by the rounding to float.
  constexpr double kRounding = 4e-7;
  // The inverse is huge instead of infinite: a segment exactly in a slab's plane must not give 0
  // times infinity.
  constexpr double kHuge = 1e15;
  const double grown = margin + kRounding * (from.cwiseAbs().maxCoeff() + margin);
  for (int k = 0; k < 3; ++k) {
    from_lower_[k] = static_cast<float>(from[k] - grown);
    from_upper_[k] = static_cast<float>(from[k] + grown);
    inverse_[k] =
        static_cast<float>(std::abs(direction[k]) > 1.0 / kHuge ? 1.0 / direction[k] : kHuge);
  }
}

}  // namespace tactus::rendering
