#include "rendering/surface/connected_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const MeshView& mesh, std::uint32_t triangle) {
  const TriangleIndices& indices = mesh.triangles[triangle];
  return {to_vec3(mesh.vertices[indices[0]]), to_vec3(mesh.vertices[indices[1]]),
          to_vec3(mesh.vertices[indices[2]])};
}

Vec3 area_vector(const MeshView& mesh, std::uint32_t triangle) {
  const Corners corners = corners_of(mesh, triangle);
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

Vec3 unit_normal(const MeshView& mesh, std::uint32_t triangle) {
  return area_vector(mesh, triangle).normalized();
}

struct NearestVisitor {
  const MeshView& mesh;
  const Vec3& q;
  MeshNearest best;

  [[nodiscard]] double reach() const { return std::sqrt(best.squared_m2); }
  void operator()(std::uint32_t t) {
    const MeshNearest here = nearest_on_triangle(mesh, t, q);
    if (here.squared_m2 < best.squared_m2) {
      best = here;
    }
  }
};

}  // namespace

// Only edges whose plane has q outside can hold the nearest point, as in triangle.cpp.
MeshNearest nearest_on_triangle(const MeshView& mesh, std::uint32_t triangle, const Vec3& q_W) {
  const Corners corners = corners_of(mesh, triangle);
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  MeshNearest best{.squared_m2 = std::numeric_limits<double>::infinity(),
                   .feature = {.triangle = triangle}};
  for (std::uint8_t k = 0; k < 3; ++k) {
    const Vec3 edge = corners[(k + 1U) % 3U] - corners[k];
    const Vec3 from_corner = q_W - corners[k];
    if (normal.cross(edge).dot(from_corner) > 0.0) {
      continue;
    }
    const double along = from_corner.dot(edge);
    const double squared_length = edge.squaredNorm();
    MeshNearest here{.point_W = corners[k], .feature = {Feature::vertex, k, triangle}};
    if (along >= squared_length) {
      here.feature.number = static_cast<std::uint8_t>((k + 1U) % 3U);
      here.point_W = corners[here.feature.number];
    } else if (along > 0.0) {
      here.feature.kind = Feature::edge;
      here.point_W = corners[k] + along / squared_length * edge;
    }
    here.squared_m2 = (q_W - here.point_W).squaredNorm();
    if (here.squared_m2 < best.squared_m2) {
      best = here;
    }
  }
  if (std::isinf(best.squared_m2)) {
    const double height = normal.dot(q_W - corners[0]) / normal.squaredNorm();
    best.point_W = q_W - height * normal;
    best.squared_m2 = height * height * normal.squaredNorm();
  }
  return best;
}

MeshNearest nearest_on_mesh(const MeshView& mesh, const Vec3& q_W) {
  NearestVisitor visitor{.mesh = mesh, .q = q_W, .best = nearest_on_triangle(mesh, 0, q_W)};
  visit_near(mesh.nodes, q_W, visitor);
  return visitor.best;
}

Vec3 pseudonormal(const ConnectedMesh& mesh, const MeshFeature& feature) {
  if (feature.kind == Feature::vertex) {
    return to_vec3(mesh.vertex_normals[mesh.mesh.triangles[feature.triangle][feature.number]]);
  }
  Vec3 own = unit_normal(mesh.mesh, feature.triangle);
  if (feature.kind == Feature::face) {
    return own;
  }
  const std::uint32_t across = mesh.neighbours[feature.triangle][feature.number];
  return across == kNoTriangle ? own : Vec3{own + unit_normal(mesh.mesh, across)};
}

SurfaceSample sample(const ConnectedMesh& mesh, const Vec3& p_W) {
  constexpr double kOnSurface_m = 1e-12;  // nearer, rounding decides where the offset points
  const MeshNearest nearest = nearest_on_mesh(mesh.mesh, p_W);
  const Vec3 outward = pseudonormal(mesh, nearest.feature);
  const Vec3 offset = p_W - nearest.point_W;
  const double distance = std::sqrt(nearest.squared_m2);
  const double sign = outward.dot(offset) < 0.0 ? -1.0 : 1.0;
  if (distance > kOnSurface_m) {
    return {.distance_m = sign * distance, .normal_W = sign / distance * offset};
  }
  const double length = outward.norm();
  return {.distance_m = sign * distance,
          .normal_W = length > 0.0 ? Vec3{outward / length} : Vec3::UnitX()};
}

}  // namespace tactus::rendering
