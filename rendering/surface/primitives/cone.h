// A cone: its base about the origin in the plane y = 0 with this radius, its tip at y = height.
#pragma once

#include <algorithm>

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct ConeSolid {
  static constexpr std::string_view kName = "cone";
  static constexpr std::array kDimensions{DimensionKey{"radius_m"}, DimensionKey{"height_m"}};
  static constexpr bool kIsConvex = true;

  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    return revolve(p, [&](const ProfilePoint& q) { return triangle(q, d[0], d[1]); });
  }

  // Planes that touch the side, and the base, from within.
  static void add_contacts(const Vec3& p, const PrimitiveDimensions& d, Contacts& contacts) {
    const double slant = std::sqrt(d[0] * d[0] + d[1] * d[1]);
    for (const Vec3& outward : round_the_axis(p)) {
      const Vec3 normal = (d[1] * outward + d[0] * Vec3::UnitY()) / slant;
      contacts.add({normal.dot(p - d[0] * outward), normal});
    }
    contacts.end_round_wall();
    contacts.add({-p.y(), -Vec3::UnitY()});
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    const Vec3& centre = X_WO.translation;
    const Vec3 axis = X_WO.rotation.col(1);
    const Vec3 tip = centre + d[1] * axis;
    const Vec3 rim = disc_extent(axis, d[0]);
    return {.lower_W = (centre - rim).cwiseMin(tip), .upper_W = (centre + rim).cwiseMax(tip)};
  }

 private:
  // The border from a to b, solid on its left, outward unit normal n: the distance from q if q is
  // in front of it.
  static ProfileMeasure from_border(const ProfilePoint& q, const ProfilePoint& a,
                                    const ProfilePoint& b, const ProfilePoint& n) {
    const ProfilePoint along = b - a;
    const double t = std::clamp((q - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const ProfilePoint offset = q - (a + t * along);
    const double height = n.dot(q - a);
    if (t > 0.0 && t < 1.0) {
      return {std::abs(height), height < 0.0 ? ProfilePoint{-n} : n};
    }
    const double distance = offset.norm();
    return {distance, distance > kNoLength_m ? ProfilePoint{offset / distance} : n};
  }

  static ProfileMeasure triangle(const ProfilePoint& q, double radius, double height) {
    const ProfilePoint rim(radius, 0.0);
    const ProfilePoint tip(0.0, height);
    const ProfilePoint side_normal =
        ProfilePoint(height, radius) / std::sqrt(height * height + radius * radius);
    const double above_side = side_normal.dot(q - rim);
    if (above_side <= 0.0 && q.y() >= 0.0) {
      return above_side >= -q.y() ? ProfileMeasure{above_side, side_normal}
                                  : ProfileMeasure{-q.y(), -ProfilePoint::UnitY()};
    }
    const ProfileMeasure base = from_border(q, ProfilePoint::Zero(), rim, -ProfilePoint::UnitY());
    const ProfileMeasure side = from_border(q, rim, tip, side_normal);
    return side.distance_m <= base.distance_m ? side : base;
  }
};

}  // namespace tactus::rendering
