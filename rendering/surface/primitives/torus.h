// A torus about the origin, its hole along y: the radius of the centre circle, and of the tube.
#pragma once

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct TorusSolid {
  static constexpr std::string_view kName = "torus";
  static constexpr std::array kDimensions{DimensionKey{"ring_radius_m"},
                                          DimensionKey{"tube_radius_m"}};
  static constexpr bool kIsConvex = false;
  static constexpr std::string_view kCondition = "a torus's tube thinner than its ring";

  static bool fits(const PrimitiveDimensions& d) { return d[1] < d[0]; }

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    return revolve(p,
                   [&](const ProfilePoint& q) { return disc(q - ProfilePoint(d[0], 0.0), d[1]); });
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    const Vec3 axis = X_WO.rotation.col(1);
    return about_origin(X_WO, disc_extent(axis, d[0]) + Vec3::Constant(d[1]));
  }

  // The tube is a ball that goes round the centre circle: the contacts are those of six balls. From
  // within the tube there is no other contact.
  static void add_contacts(const Vec3& p, const PrimitiveDimensions& d, Contacts& contacts) {
    for (const Vec3& outward : round_the_axis(p)) {
      const Vec3 offset = p - d[0] * outward;
      const double length = offset.norm();
      if (length <= d[1]) {
        return;
      }
      contacts.add({length - d[1], offset / length});
    }
    contacts.end_round_wall();
  }

 private:
  static ProfileMeasure disc(const ProfilePoint& q, double radius) {
    const double length = q.norm();
    return {length - radius,
            length > kNoLength_m ? ProfilePoint{q / length} : ProfilePoint::UnitX()};
  }
};

}  // namespace tactus::rendering
