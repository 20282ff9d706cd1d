// Makes a list of triangles fit for touch: equal vertices become one, triangles without area are
// dropped, and vertices are ordered. Steps of mesh_bake.h.
#pragma once

#include <cstdint>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// A triangle whose smallest height is below this has no meaningful normal: 1 nm is far below the
// resolution of a float at the size of a hand.
inline constexpr double kDegenerateHeight_m = 1e-9;

// Gives corners at the same place the same vertex, and returns how many vertices were removed. With
// weld_m = 0 only exactly equal positions count as the same place; above 0, a vertex joins the
// first kept vertex within `weld_m`, in the order of the list.
std::uint32_t weld(TriangleMesh& mesh, double weld_m);

// Two rims nearer than this are one: a point in contact stands 0.5 um above the surface
// (rendering/contact/proxy_rest.h), and would roll over the edges of a gap as narrow as that.
inline constexpr double kRimGap_m = 5e-7;

// Closes narrow gaps: gives vertices of open edges within kRimGap_m of each other the same vertex,
// and returns how many were removed. It changes nothing if a triangle would lose its area or an
// edge would get a third triangle or a wrong winding. Vertices that are not used stay in the list.
std::uint32_t weld_rims(TriangleMesh& mesh);

// Drops triangles with a repeated vertex or a height below kDegenerateHeight_m, and returns their
// number. Duplicated triangles stay.
std::uint32_t drop_degenerate(TriangleMesh& mesh);

// Renumbers the vertices in the order in which the triangles first use them, and drops unused ones,
// so that near triangles have their vertices near in memory.
void order_vertices_by_use(TriangleMesh& mesh);

}  // namespace tactus::host
