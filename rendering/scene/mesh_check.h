// The limits that a baked mesh must keep for the controller to use it without further questions.
// SceneImage checks every mesh of an image.
#pragma once

#include <cstdint>
#include <expected>
#include <span>

#include "rendering/objects/object.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

// The triangles across the three edges of a triangle; edge k runs from its vertex k to k + 1.
using TriangleNeighbours = std::array<std::uint32_t, 3>;
// Says that an edge is open.
inline constexpr std::uint32_t kNoNeighbour = 0xffffffff;

// A mesh with what baking adds to it; views of the image.
struct BakedMeshView {
  MeshView mesh;
  // The neighbours, one entry a triangle; kNoNeighbour at open edges.
  std::span<const TriangleNeighbours> neighbours;
  // The normals, one a vertex, of unit length.
  std::span<const Float3> vertex_normals;
};

// Returns an error unless all vertices and normals are finite, every index is in range, neighbours
// are mutual, and check_hierarchy() passes. The time grows with the mesh, the memory does not. The
// error's object is left at kNoObject.
std::expected<void, SceneError> check_mesh(const BakedMeshView& baked);

}  // namespace tactus::rendering
