// Meshes of primitives, for pictures and exports. The controller touches a primitive by its formula
// and needs no mesh.
#pragma once

#include "host_tools/mesh/triangle_mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::host {

// Returns the closed surface in the world frame, m, wound counter-clockwise seen from outside.
// Every vertex lies on the surface. A box is exact, the other built-in round primitives have 48
// sides, and a primitive without a mesh of its own is the one that mesh_level_set finds. A plane,
// which is infinite, is shown as a square of 0.2 m about its origin.
TriangleMesh primitive_mesh(const rendering::Primitive& primitive);

}  // namespace tactus::host
