// Which triangle lies across which edge, and the normals at the vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"
#include "rendering/scene/mesh_check.h"

namespace tactus::host {

struct Topology {
  std::vector<rendering::TriangleNeighbours> neighbours;  // rendering/scene/mesh_check.h
  std::uint32_t open_edges = 0;                           // on one triangle
  std::uint32_t non_manifold_edges = 0;                   // on three or more; have no neighbours
  std::uint32_t inconsistent_edges = 0;  // on two triangles that run it in the same direction
};

// Two triangles are neighbours across an edge that they, and no third, have. No triangle may repeat
// a vertex. Time in proportion to the mesh.
Topology find_topology(std::span<const rendering::TriangleIndices> triangles,
                       std::size_t vertex_count);

// Angle-weighted vertex normals (Thurmer and Wuthrich, "Computing vertex normals from polygonal
// facets", 1998): unit length, and independent of how a face is cut into triangles. Zero where the
// faces cancel out.
std::vector<rendering::Float3> angle_weighted_normals(
    std::span<const rendering::Float3> vertices,
    std::span<const rendering::TriangleIndices> triangles);

}  // namespace tactus::host
