#include "rendering/bodies/primitive_hull.h"

#include <cstdint>

namespace tactus::rendering {
namespace {

// Vertex i of a box lies at +x where bit 0 of i is set, at +y for bit 1, at +z for bit 2. Its faces
// are -x, +x, -y, +y, -z, +z.
constexpr std::array<std::uint8_t, 24> kBoxCorners{0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                                   2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
constexpr std::array<HullEdge, 12> kBoxEdges{{{0, 1, 2, 4},
                                              {2, 3, 4, 3},
                                              {4, 5, 5, 2},
                                              {6, 7, 3, 5},
                                              {0, 2, 4, 0},
                                              {1, 3, 1, 4},
                                              {4, 6, 0, 5},
                                              {5, 7, 5, 1},
                                              {0, 4, 0, 2},
                                              {1, 5, 2, 1},
                                              {2, 6, 3, 0},
                                              {3, 7, 1, 3}}};
// The axis of a capsule.
constexpr std::array<HullEdge, 1> kAxis{{{0, 1, 0, 0}}};

}  // namespace

void PrimitiveHull::make(const Primitive& primitive) {
  const auto& d = primitive.dimensions_m;
  const RigidPose& X_WO = primitive.X_WO;
  kind_ = primitive.kind;
  radius_m_ = kind_ == PrimitiveKind::box ? 0.0 : d[0];
  if (kind_ == PrimitiveKind::sphere) {
    vertices_O_[0] = X_WO.translation;
  } else if (kind_ == PrimitiveKind::capsule) {
    vertices_O_[0] = X_WO.point(-d[1] * Vec3::UnitY());
    vertices_O_[1] = X_WO.point(d[1] * Vec3::UnitY());
  } else {
    for (std::uint32_t i = 0; i < vertices_O_.size(); ++i) {
      const auto half = [&](std::uint32_t axis) {
        return (i >> axis & 1U) != 0 ? d[axis] : -d[axis];
      };
      vertices_O_[i] = X_WO.point({half(0), half(1), half(2)});
    }
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      const Vec3 outward = (f % 2 == 0 ? -1.0 : 1.0) * Vec3::Unit(static_cast<Eigen::Index>(f / 2));
      faces_[f] = {.normal_O = X_WO.direction(outward), .first = 4 * f, .count = 4};
    }
  }
}

ConvexHull PrimitiveHull::hull() const {
  switch (kind_) {
    case PrimitiveKind::sphere:
      return {.vertices_O = {vertices_O_.data(), 1}, .radius_m = radius_m_};
    case PrimitiveKind::capsule:
      return {.vertices_O = {vertices_O_.data(), 2}, .edges = kAxis, .radius_m = radius_m_};
    default:
      return {
          .vertices_O = vertices_O_, .faces = faces_, .corners = kBoxCorners, .edges = kBoxEdges};
  }
}

}  // namespace tactus::rendering
