// A capsule about the origin, along y: its radius, and half the length of its axis without the
// caps.
#pragma once

#include <algorithm>

#include "rendering/surface/primitive_parts.h"
#include "rendering/surface/primitives/sphere.h"

namespace tactus::rendering {

struct CapsuleSolid {
  static constexpr std::string_view kName = "capsule";
  static constexpr std::array kDimensions{DimensionKey{"radius_m"},
                                          DimensionKey{.key = "height_m", .factor = 0.5}};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    return SphereSolid::measure(p - std::clamp(p.y(), -d[1], d[1]) * Vec3::UnitY(), d);
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    return about_origin(X_WO, d[1] * X_WO.rotation.col(1).cwiseAbs() + Vec3::Constant(d[0]));
  }
};

}  // namespace tactus::rendering
