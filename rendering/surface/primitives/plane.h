// The half space y <= 0.
#pragma once

#include "rendering/limits.h"
#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct PlaneSolid {
  static constexpr std::string_view kName = "plane";
  static constexpr std::array<DimensionKey, 0> kDimensions{};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& /*d*/) {
    return {p.y(), Vec3::UnitY()};
  }

  // The box is the world, though the plane does not end there.
  static Bounds extent(const RigidPose& /*X_WO*/, const PrimitiveDimensions& /*d*/) {
    return {.lower_W = Vec3::Constant(-kWorldBound_m), .upper_W = Vec3::Constant(kWorldBound_m)};
  }
};

}  // namespace tactus::rendering
