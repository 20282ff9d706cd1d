#include "rendering/scene/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "rendering/scene/hierarchy_check.h"

namespace tactus::rendering {
namespace {

using Result = std::expected<void, SceneError>;

bool has_finite_coordinates(const Float3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Returns the fault at the first vertex or normal with a coordinate that is not a number.
Result check_finite(std::span<const Float3> values, SceneFault fault) {
  const auto bad = std::ranges::find_if_not(values, has_finite_coordinates);
  if (bad != values.end()) {
    return fail(fault, static_cast<std::size_t>(bad - values.begin()));
  }
  return {};
}

// Checks that every triangle's vertices are there.
Result check_triangles(const MeshView& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex >= mesh.vertices.size()) {
        return fail(SceneFault::vertex_index, i);
      }
    }
  }
  return {};
}

// Checks that neighbours are there and name each other. The neighbour across an edge need not be
// wound alike: a walk tests that itself.
Result check_neighbours(std::span<const TriangleNeighbours> neighbours) {
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    for (const std::uint32_t other : neighbours[i]) {
      if (other == kNoNeighbour) {
        continue;
      }
      if (other >= neighbours.size() || other == i ||
          std::ranges::find(neighbours[other], i) == neighbours[other].end()) {
        return fail(SceneFault::neighbour_index, i);
      }
    }
  }
  return {};
}

// Checks that there is a mesh, with as many normals as vertices and as many neighbours as
// triangles.
Result check_sizes(const BakedMeshView& baked) {
  const MeshView& mesh = baked.mesh;
  if (mesh.vertices.empty() || mesh.triangles.empty() || mesh.nodes.empty()) {
    return fail(SceneFault::empty_mesh);
  }
  if (baked.vertex_normals.size() != mesh.vertices.size() ||
      baked.neighbours.size() != mesh.triangles.size()) {
    return fail(SceneFault::array_sizes);
  }
  return {};
}

}  // namespace

// The order matters: check_hierarchy() needs finite vertices and vertex indices in range.
Result check_mesh(const BakedMeshView& baked) {
  if (const Result sizes = check_sizes(baked); !sizes) {
    return sizes;
  }
  if (const Result finite = check_finite(baked.mesh.vertices, SceneFault::vertex_not_finite);
      !finite) {
    return finite;
  }
  if (const Result finite = check_finite(baked.vertex_normals, SceneFault::normal_not_finite);
      !finite) {
    return finite;
  }
  if (const Result triangles = check_triangles(baked.mesh); !triangles) {
    return triangles;
  }
  if (const Result neighbours = check_neighbours(baked.neighbours); !neighbours) {
    return neighbours;
  }
  return check_hierarchy(baked.mesh);
}

}  // namespace tactus::rendering
