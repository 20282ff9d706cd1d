// Normals for force shading: round where faces meet at a small angle, sharp elsewhere.
#pragma once

#include <span>
#include <vector>

#include "rendering/material/surface_detail.h"
#include "rendering/scene/mesh_check.h"

namespace tactus::host {

// One a triangle. A corner's normal is the angle-weighted mean over the faces about its vertex that
// can be reached from its triangle across edges of at most `angle_limit_rad` between the faces'
// normals; an edge above it stays sharp. Time in proportion to the mesh, and to the square of how
// many triangles meet in a vertex.
std::vector<rendering::CornerNormals> corner_normals(
    std::span<const rendering::Float3> vertices,
    std::span<const rendering::TriangleIndices> triangles,
    std::span<const rendering::TriangleNeighbours> neighbours, double angle_limit_rad);

}  // namespace tactus::host
