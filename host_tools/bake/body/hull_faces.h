// Joins the triangles of a hull that are in one plane. A step of convex_hull.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The corners of a polygon as indices of points, counter-clockwise seen from outside.
using HullPolygon = std::vector<std::uint32_t>;

// Returns the faces of a closed convex surface of triangles. Neighbours whose corners are within
// the tolerance of one plane become one polygon, and a vertex that is left in the middle of a face
// or of an edge is left out. If the polygons were no polyhedron, as may happen to shapes that are
// hardly larger than the tolerance, it is tried with a smaller one, and at last the triangles are
// returned as they are.
std::vector<HullPolygon> join_coplanar(std::span<const Vec3> points,
                                       std::span<const rendering::TriangleIndices> triangles,
                                       double tolerance_m);

// Returns true if the polygons are the faces of a polyhedron without holes: every directed edge
// has one in the other direction, every vertex three faces or more, and V - E + F = 2.
bool is_polyhedron(std::span<const HullPolygon> polygons);

}  // namespace tactus::host
