#include "rendering/geometry/hierarchy_query.h"

#include <limits>

namespace tactus::rendering {

Vec3 slab_inverse(const Vec3& direction) {
  // Huge instead of infinite: a segment that runs exactly in a slab's plane must not meet 0 times
  // infinity.
  constexpr double kHuge = 1e300;
  return direction.unaryExpr([](double d) { return std::abs(d) > 1.0 / kHuge ? 1.0 / d : kHuge; });
}

double entry_travel(const BvhNode& node, const Vec3& from, const Vec3& inverse_direction,
                    double margin, double limit) {
  const Vec3 lower = to_vec3(node.lower) - from;
  const Vec3 upper = to_vec3(node.upper) - from;
  double enter = 0.0;
  double leave = limit;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double a = (lower[k] - margin) * inverse_direction[k];
    const double b = (upper[k] + margin) * inverse_direction[k];
    enter = std::max(enter, a < b ? a : b);
    leave = std::min(leave, a < b ? b : a);
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace tactus::rendering
