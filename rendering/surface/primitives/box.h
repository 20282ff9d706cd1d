// A box about the origin: half its length along x, y and z.
#pragma once

#include "rendering/surface/primitive_parts.h"

namespace tactus::rendering {

struct BoxSolid {
  static constexpr std::string_view kName = "box";
  static constexpr std::array kDimensions{DimensionKey{.key = "size_m", .factor = 0.5, .count = 3}};
  static constexpr bool kIsConvex = true;

  // `over` is how far the point stands beyond each pair of faces, negative between them.
  static Measure measure(const Vec3& p, const PrimitiveDimensions& d) {
    const Vec3 over = p.cwiseAbs() - Vec3(d[0], d[1], d[2]);
    Eigen::Index face = 0;
    if (over.maxCoeff(&face) > kNoLength_m) {
      const Vec3 outside = over.cwiseMax(0.0);
      const double distance = outside.norm();
      return {distance, Vec3{sign_of(p.x()) * outside.x(), sign_of(p.y()) * outside.y(),
                             sign_of(p.z()) * outside.z()} /
                            distance};
    }
    return {over[face], sign_of(p[face]) * Vec3::Unit(face)};
  }

  // The six faces, from within.
  static void add_contacts(const Vec3& p, const PrimitiveDimensions& d, Contacts& contacts) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double half = d[static_cast<std::size_t>(k)];
      contacts.add({p[k] - half, Vec3::Unit(k)});
      contacts.add({-p[k] - half, -Vec3::Unit(k)});
    }
  }

  static Bounds extent(const RigidPose& X_WO, const PrimitiveDimensions& d) {
    return about_origin(X_WO, X_WO.rotation.cwiseAbs() * Vec3(d[0], d[1], d[2]));
  }
};

}  // namespace tactus::rendering
