#include "firmware/safety/felt_region.h"

namespace tactus::firmware {

rendering::Bounds grown(const rendering::Bounds& box, double by_m) {
  return {.lower_W = box.lower_W - Vec3::Constant(by_m),
          .upper_W = box.upper_W + Vec3::Constant(by_m)};
}

FeltRegion slab(const Vec3& point_W, const Vec3& normal_W, double below_m, double above_m) {
  const double height = normal_W.dot(point_W);
  return {.normal_W = normal_W, .lowest_m = height - below_m, .highest_m = height + above_m};
}

rendering::Bounds common_box(const rendering::Bounds& a, const rendering::Bounds& b) {
  return {.lower_W = a.lower_W.cwiseMax(b.lower_W), .upper_W = a.upper_W.cwiseMin(b.upper_W)};
}

bool has_point_in(const rendering::Bounds& box, const FeltRegion& region) {
  const Vec3 middle_W = 0.5 * (box.lower_W + box.upper_W);
  const Vec3 half_W = 0.5 * (box.upper_W - box.lower_W);
  const double height = region.normal_W.dot(middle_W);
  const double spread = region.normal_W.cwiseAbs().dot(half_W);
  return half_W.minCoeff() >= 0.0 && height - spread <= region.highest_m &&
         height + spread >= region.lowest_m;
}

}  // namespace tactus::firmware
