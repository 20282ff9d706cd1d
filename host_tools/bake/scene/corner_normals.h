// Computes the normals for force shading: the felt surface is round where faces meet at a small
// angle, and sharp elsewhere. The baker calls it for objects with the key `shading`.
#pragma once

#include <span>
#include <vector>

#include "rendering/material/surface_detail.h"
#include "rendering/scene/mesh_check.h"

namespace tactus::host {

// Returns three encoded unit normals a triangle. A corner's normal is the angle-weighted mean over
// the faces around its vertex that can be reached from its triangle across edges whose faces'
// normals differ by at most `angle_limit_rad`; an edge with a larger angle stays sharp. The time
// grows with the mesh, and with the square of the number of triangles at a vertex.
std::vector<rendering::CornerNormals> corner_normals(
    std::span<const rendering::Float3> vertices,
    std::span<const rendering::TriangleIndices> triangles,
    std::span<const rendering::TriangleNeighbours> neighbours, double angle_limit_rad);

}  // namespace tactus::host
