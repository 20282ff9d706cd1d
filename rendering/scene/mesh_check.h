// The limits that a baked mesh must keep for the controller to use it without further questions.
#pragma once

#include <cstdint>
#include <expected>
#include <span>

#include "rendering/objects/object.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

// The triangles across the three edges of a triangle; edge k runs from its vertex k to k + 1.
using TriangleNeighbours = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kNoNeighbour = 0xffffffff;

struct BakedMeshView {
  MeshView mesh;
  std::span<const TriangleNeighbours> neighbours;  // one a triangle; none at open edges
  std::span<const Float3> vertex_normals;          // one a vertex, unit length
};

// Time grows with the mesh, memory does not. The error's object is left at kNoObject.
std::expected<void, SceneError> check_mesh(const BakedMeshView& baked);

}  // namespace tactus::rendering
