// Makes a triangle soup fit for touch: equal vertices become one, triangles without area go.
#pragma once

#include <cstdint>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// A triangle with a height below this has no normal worth the name: a nanometre is far below what a
// float resolves at the size of a hand.
inline constexpr double kDegenerateHeight_m = 1e-9;

// Gives all corners at the same place the same vertex, and returns how many vertices have gone.
// weld_m = 0 merges exactly equal positions; above, a vertex goes to the first kept one within
// weld_m, in the order of the list.
std::uint32_t weld(TriangleMesh& mesh, double weld_m);

// Drops triangles with a repeated vertex or a height below kDegenerateHeight_m, and returns how
// many they were. Duplicated triangles stay.
std::uint32_t drop_degenerate(TriangleMesh& mesh);

// Renumbers the vertices in the order in which the triangles use them, without the unused, so that
// near triangles find near vertices.
void order_vertices_by_use(TriangleMesh& mesh);

}  // namespace tactus::host
