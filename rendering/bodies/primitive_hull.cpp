#include "rendering/bodies/primitive_hull.h"

#include <cstddef>
#include <cstdint>
#include <numbers>

#include "rendering/geometry/portable_math.h"

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

constexpr std::uint8_t kSides = PrimitiveHull::kSides;
constexpr std::size_t kManySides = kSides;
constexpr std::uint8_t next_side(std::uint8_t i) {
  return static_cast<std::uint8_t>((i + 1) % kSides);
}
constexpr std::uint8_t number(int i) {
  return static_cast<std::uint8_t>(i);
}

// A prism: its corners at the bottom, counter-clockwise seen from above, and those at the top. The
// faces are the sides, the bottom and the top.
constexpr auto kPrismCorners = [] {
  std::array<std::uint8_t, 6 * kManySides> corners{};
  for (std::uint8_t i = 0; i < kSides; ++i) {
    corners[4 * std::size_t{i}] = i;
    corners[4 * std::size_t{i} + 1] = next_side(i);
    corners[4 * std::size_t{i} + 2] = number(kSides + next_side(i));
    corners[4 * std::size_t{i} + 3] = number(kSides + i);
    corners[4 * kManySides + i] = number(kSides - 1 - i);
    corners[5 * kManySides + i] = number(kSides + i);
  }
  return corners;
}();
constexpr auto kPrismEdges = [] {
  std::array<HullEdge, 3 * kManySides> edges{};
  for (std::uint8_t i = 0; i < kSides; ++i) {
    const std::uint8_t before = number((i + kSides - 1) % kSides);
    edges[i] = {.from = i, .to = next_side(i), .left = i, .right = kSides};
    edges[kSides + i] = {.from = number(kSides + i),
                         .to = number(kSides + next_side(i)),
                         .left = kSides + 1,
                         .right = i};
    edges[2 * kManySides + i] = {.from = i, .to = number(kSides + i), .left = before, .right = i};
  }
  return edges;
}();
// A pyramid: the corners of its base, and its tip. The faces are the sides and the base.
constexpr auto kPyramidCorners = [] {
  std::array<std::uint8_t, 4 * kManySides> corners{};
  for (std::uint8_t i = 0; i < kSides; ++i) {
    corners[3 * std::size_t{i}] = i;
    corners[3 * std::size_t{i} + 1] = next_side(i);
    corners[3 * std::size_t{i} + 2] = kSides;
    corners[3 * kManySides + i] = number(kSides - 1 - i);
  }
  return corners;
}();
constexpr auto kPyramidEdges = [] {
  std::array<HullEdge, 2 * kManySides> edges{};
  for (std::uint8_t i = 0; i < kSides; ++i) {
    const std::uint8_t before = number((i + kSides - 1) % kSides);
    edges[i] = {.from = i, .to = next_side(i), .left = i, .right = kSides};
    edges[kSides + i] = {.from = i, .to = kSides, .left = before, .right = i};
  }
  return edges;
}();

// Returns the unit vector from the axis, counter-clockwise seen from above: `half_sides` half sides
// on from x.
Vec3 round_about(int half_sides) {
  const auto [sine, cosine] = sine_cosine(std::numbers::pi * half_sides / kSides);
  return {cosine, 0.0, -sine};
}

// Returns the distance of the corners from the axis over the circle's radius: the sides are as far
// within as the corners are outside.
double corner_factor() {
  return 2.0 / (1.0 + sine_cosine(std::numbers::pi / kSides).cosine);
}

}  // namespace

void PrimitiveHull::make(const Primitive& primitive) {
  const auto& d = primitive.dimensions_m;
  const RigidPose& X_WO = primitive.X_WO;
  kind_ = primitive.kind;
  radius_m_ = 0.0;
  switch (kind_) {
    case PrimitiveKind::sphere:
      radius_m_ = d[0];
      vertices_O_[0] = X_WO.translation;
      break;
    case PrimitiveKind::capsule:
      radius_m_ = d[0];
      vertices_O_[0] = X_WO.point(-d[1] * Vec3::UnitY());
      vertices_O_[1] = X_WO.point(d[1] * Vec3::UnitY());
      break;
    case PrimitiveKind::cylinder:
      make_cylinder(primitive);
      break;
    case PrimitiveKind::cone:
      make_cone(primitive);
      break;
    default:
      make_box(primitive);
      break;
  }
}

void PrimitiveHull::make_box(const Primitive& primitive) {
  const auto& d = primitive.dimensions_m;
  const RigidPose& X_WO = primitive.X_WO;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto half = [&](std::uint32_t axis) {
      return (i >> axis & 1U) != 0 ? d[axis] : -d[axis];
    };
    vertices_O_[i] = X_WO.point({half(0), half(1), half(2)});
  }
  for (std::uint32_t f = 0; f < 6; ++f) {
    const Vec3 outward = (f % 2 == 0 ? -1.0 : 1.0) * Vec3::Unit(static_cast<Eigen::Index>(f / 2));
    faces_[f] = {.normal_O = X_WO.direction(outward), .first = 4 * f, .count = 4};
  }
}

void PrimitiveHull::make_cylinder(const Primitive& primitive) {
  const auto& [radius, half_height, unused] = primitive.dimensions_m;
  const RigidPose& X_WO = primitive.X_WO;
  const Vec3 up = half_height * Vec3::UnitY();
  for (std::uint8_t i = 0; i < kSides; ++i) {
    const Vec3 corner = corner_factor() * radius * round_about(2 * i);
    vertices_O_[i] = X_WO.point(corner - up);
    vertices_O_[kSides + i] = X_WO.point(corner + up);
    faces_[i] = {.normal_O = X_WO.direction(round_about(2 * i + 1)), .first = 4U * i, .count = 4};
  }
  const Vec3 axis = X_WO.direction(Vec3::UnitY());
  faces_[kSides] = {.normal_O = -axis, .first = 4 * kManySides, .count = kSides};
  faces_[kSides + 1] = {.normal_O = axis, .first = 5 * kManySides, .count = kSides};
  circles_ = {
      .axis_O = axis, .centers_O = {X_WO.point(-up), X_WO.point(up)}, .radii_m = {radius, radius}};
}

void PrimitiveHull::make_cone(const Primitive& primitive) {
  const auto& [radius, height, unused] = primitive.dimensions_m;
  const RigidPose& X_WO = primitive.X_WO;
  const double corner = corner_factor() * radius;
  // The sides' distance from the axis at the base.
  const double within = 2.0 * radius - corner;
  for (std::uint8_t i = 0; i < kSides; ++i) {
    vertices_O_[i] = X_WO.point(corner * round_about(2 * i));
    const Vec3 outward = height * round_about(2 * i + 1) + within * Vec3::UnitY();
    faces_[i] = {.normal_O = X_WO.direction(outward.normalized()), .first = 3U * i, .count = 3};
  }
  const Vec3 axis = X_WO.direction(Vec3::UnitY());
  vertices_O_[kSides] = X_WO.point(height * Vec3::UnitY());
  faces_[kSides] = {.normal_O = -axis, .first = 3 * kManySides, .count = kSides};
  circles_ = {.axis_O = axis,
              .centers_O = {X_WO.translation, vertices_O_[kSides]},
              .radii_m = {radius, 0.0}};
}

ConvexHull PrimitiveHull::hull() const {
  const std::span<const Vec3> vertices = vertices_O_;
  const std::span<const HullFace> faces = faces_;
  switch (kind_) {
    case PrimitiveKind::sphere:
      return {.vertices_O = vertices.first(1), .radius_m = radius_m_};
    case PrimitiveKind::capsule:
      return {.vertices_O = vertices.first(2), .edges = kAxis, .radius_m = radius_m_};
    case PrimitiveKind::cylinder:
      return {.vertices_O = vertices,
              .faces = faces,
              .corners = kPrismCorners,
              .edges = kPrismEdges,
              .circles = &circles_};
    case PrimitiveKind::cone:
      return {.vertices_O = vertices.first(kSides + 1),
              .faces = faces.first(kSides + 1),
              .corners = kPyramidCorners,
              .edges = kPyramidEdges,
              .circles = &circles_};
    default:
      return {.vertices_O = vertices.first(8),
              .faces = faces.first(6),
              .corners = kBoxCorners,
              .edges = kBoxEdges};
  }
}

}  // namespace tactus::rendering
