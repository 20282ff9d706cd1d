// A mesh that knows which triangle lies across each edge: its faces, edges and vertices as
// features, and the signed distance to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/triangle.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

inline constexpr std::uint32_t kNoTriangle = 0xffffffff;

struct ConnectedMesh {
  MeshView mesh;
  // The neighbours across the edges of each triangle: edge k is from its corner k to k + 1;
  // kNoTriangle at an open edge.
  std::span<const std::array<std::uint32_t, 3>> neighbours;
  // The normal of each vertex: angle-weighted and of unit length, or zero where the faces cancel
  // out.
  std::span<const Float3> vertex_normals;
};

// A face, an edge or a vertex, named by a triangle that has it.
struct MeshFeature {
  Feature kind = Feature::face;
  std::uint8_t number = 0;  // which edge or corner of the triangle
  std::uint32_t triangle = 0;
};

struct MeshNearest {
  double squared_m2 = 0.0;  // from the query point
  Vec3 point_W = Vec3::Zero();
  MeshFeature feature;
};

// The nearest point of one triangle.
MeshNearest nearest_on_triangle(const MeshView& mesh, std::uint32_t triangle, const Vec3& q_W);

// The nearest point of the mesh, through the hierarchy: time grows with the logarithm of the mesh
// where the query is near it, and worse near a centre. The mesh must have a triangle.
MeshNearest nearest_on_mesh(const MeshView& mesh, const Vec3& q_W);

// The direction that tells inside from outside at a feature (Baerentzen and Aanaes, "Signed
// distance computation using the angle weighted pseudonormal", IEEE TVCG 11(3), 2005). Not unit.
Vec3 pseudonormal(const ConnectedMesh& mesh, const MeshFeature& feature);

// Signed distance and its gradient, as for primitives. Exact for a closed, consistently wound mesh
// that does not intersect itself; of another one, a sign of the nearest feature alone.
SurfaceSample sample(const ConnectedMesh& mesh, const Vec3& p_W);

}  // namespace tactus::rendering
