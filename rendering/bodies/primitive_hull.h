// The hulls of the primitives that have few corners: sphere, capsule and box.
#pragma once

#include <array>

#include "rendering/geometry/convex_hull.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// Returns true for the kinds of which PrimitiveHull makes a hull.
constexpr bool has_hull(PrimitiveKind kind) {
  return kind == PrimitiveKind::sphere || kind == PrimitiveKind::capsule ||
         kind == PrimitiveKind::box;
}

// Returns true for the kinds that stop bodies where they are no bodies themselves.
constexpr bool stops_bodies(PrimitiveKind kind) {
  return has_hull(kind) || kind == PrimitiveKind::plane;
}

// The vertices and the faces of a primitive's hull.
class PrimitiveHull {
 public:
  // Makes the hull of a valid primitive whose kind has_hull(), in the frame that its pose leads to.
  void make(const Primitive& primitive);

  // Returns the hull. It refers to this object.
  [[nodiscard]] ConvexHull hull() const;

 private:
  std::array<Vec3, 8> vertices_O_;
  std::array<HullFace, 6> faces_;
  PrimitiveKind kind_ = PrimitiveKind::sphere;
  double radius_m_ = 0.0;
};

}  // namespace tactus::rendering
