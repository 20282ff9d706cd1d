// The hulls of convex primitives: sphere, capsule, box, cylinder and cone.
#pragma once

#include <array>
#include <cstdint>

#include "rendering/geometry/convex_hull.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// Returns true for the kinds of which PrimitiveHull makes a hull.
constexpr bool has_hull(PrimitiveKind kind) {
  return kind == PrimitiveKind::sphere || kind == PrimitiveKind::capsule ||
         kind == PrimitiveKind::box || kind == PrimitiveKind::cylinder ||
         kind == PrimitiveKind::cone;
}

// The vertices and the faces of a primitive's hull.
class PrimitiveHull {
 public:
  // The sides of the prism or the pyramid that stands for a cylinder or a cone. Its corners are
  // outside of the circle and its sides inside, by 0.43 percent of the radius each.
  static constexpr std::uint8_t kSides = 24;

  PrimitiveHull() = default;

  // Makes the hull of a valid primitive whose kind has_hull(), in the frame that its pose leads to.
  void make(const Primitive& primitive);

  // Returns the hull. It refers to this object.
  [[nodiscard]] ConvexHull hull() const;

 private:
  void make_box(const Primitive& primitive);
  void make_cylinder(const Primitive& primitive);
  void make_cone(const Primitive& primitive);

  std::array<Vec3, std::size_t{2} * kSides> vertices_O_;
  std::array<HullFace, kSides + 2> faces_;
  PrimitiveKind kind_ = PrimitiveKind::sphere;
  double radius_m_ = 0.0;
  HullCircles circles_;
};

}  // namespace tactus::rendering
