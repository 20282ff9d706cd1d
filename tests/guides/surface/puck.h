// A puck about the origin: a disc in the plane y = 0 of the first radius, thickened on all sides by
// the second, the radius of its edge.
#pragma once

#include <algorithm>

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct PuckSolid {
  static constexpr std::string_view kName = "puck";
  static constexpr std::array kDimensions{DimensionKey{"radius_m"}, DimensionKey{"edge_radius_m"}};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    return revolve(p, [&](const ProfilePoint& q) -> ProfileMeasure {
      const ProfilePoint offset(std::max(0.0, q.x() - d[0]), q.y());
      const double distance = offset.norm();
      return {distance - d[1],
              distance > kNoLength_m ? ProfilePoint{offset / distance} : ProfilePoint::UnitY()};
    });
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    const Vec3 axis = X_WO.rotation.col(1);
    return about_origin(X_WO, disc_extent(axis, d[0]) + Vec3::Constant(d[1]));
  }
};

}  // namespace tactus::rendering
