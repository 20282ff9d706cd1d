// Primitives as meshes: what they look like. Touching them needs none.
#pragma once

#include "host_tools/mesh/triangle_mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::host {

// World frame, wound counter-clockwise seen from outside; every vertex lies on the surface. Of a
// plane a square of 0.2 m about its origin, of all others the whole closed surface: a box exactly,
// the other ready ones as 48-sided, and any new one as mesh_level_set finds it.
TriangleMesh primitive_mesh(const rendering::Primitive& primitive);

}  // namespace tactus::host
