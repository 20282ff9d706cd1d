// Finds which triangle lies across which edge, and the normals at the vertices. Steps of
// mesh_bake.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"
#include "rendering/scene/mesh_check.h"

namespace tactus::host {

// The neighbours of all triangles, and counts of edges that are not as in a closed surface.
struct Topology {
  // For each triangle and edge the triangle across it, or kNoNeighbour
  // (rendering/scene/mesh_check.h).
  std::vector<rendering::TriangleNeighbours> neighbours;
  // Edges of one triangle only.
  std::uint32_t open_edges = 0;
  // Edges of three or more triangles; these have no neighbours.
  std::uint32_t non_manifold_edges = 0;
  // Edges of two triangles that run along it in the same direction: one of them is wound the wrong
  // way.
  std::uint32_t inconsistent_edges = 0;
};

// Returns the topology. Two triangles are neighbours across an edge that belongs to them and no
// third. No triangle may repeat a vertex. The time is proportional to the mesh.
Topology find_topology(std::span<const rendering::TriangleIndices> triangles,
                       std::size_t vertex_count);

// Returns the vertex normals weighted by the faces' angles (Thurmer and Wuthrich, "Computing vertex
// normals from polygonal facets", 1998): of unit length, and independent of how a face is cut into
// triangles. A normal is zero where the faces cancel out.
std::vector<rendering::Float3> angle_weighted_normals(
    std::span<const rendering::Float3> vertices,
    std::span<const rendering::TriangleIndices> triangles);

}  // namespace tactus::host
