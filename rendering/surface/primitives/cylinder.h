// A cylinder about the origin, along y: its radius and half its height.
#pragma once

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct CylinderSolid {
  static constexpr std::string_view kName = "cylinder";
  static constexpr std::array kDimensions{DimensionKey{"radius_m"},
                                          DimensionKey{.key = "height_m", .factor = 0.5}};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    return revolve(p, [&](const ProfilePoint& q) { return rectangle(q, d[0], d[1]); });
  }

  // Planes that touch the side, and the two ends, from within.
  static void add_contacts(const Vec3& p, const PrimitiveDimensions& d, Contacts& contacts) {
    for (const Vec3& outward : round_the_axis(p)) {
      contacts.add({p.dot(outward) - d[0], outward});
    }
    contacts.end_round_wall();
    contacts.add({p.y() - d[1], Vec3::UnitY()});
    contacts.add({-p.y() - d[1], -Vec3::UnitY()});
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    const Vec3 axis = X_WO.rotation.col(1);
    return about_origin(X_WO, d[1] * axis.cwiseAbs() + disc_extent(axis, d[0]));
  }

 private:
  static ProfileMeasure rectangle(const ProfilePoint& q, double radius, double half_height) {
    const ProfilePoint over(q.x() - radius, std::abs(q.y()) - half_height);
    if (over.maxCoeff() > kNoLength_m) {
      const ProfilePoint outside = over.cwiseMax(0.0);
      const double distance = outside.norm();
      return {distance, ProfilePoint{outside.x(), sign_of(q.y()) * outside.y()} / distance};
    }
    return over.x() >= over.y() ? ProfileMeasure{over.x(), ProfilePoint::UnitX()}
                                : ProfileMeasure{over.y(), sign_of(q.y()) * ProfilePoint::UnitY()};
  }
};

}  // namespace tactus::rendering
