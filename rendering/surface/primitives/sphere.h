// A sphere about the origin: its radius.
#pragma once

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct SphereSolid {
  static constexpr std::string_view kName = "sphere";
  static constexpr std::array kDimensions{DimensionKey{"radius_m"}};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    const double length = p.norm();
    return {length - d[0], length > kNoLength_m ? Vec3{p / length} : Vec3::UnitX()};
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    return about_origin(X_WO, Vec3::Constant(d[0]));
  }
};

}  // namespace tactus::rendering
