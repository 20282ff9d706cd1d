// Spheres of any fineness, as meshes for benchmarks, tests and certificates.
#pragma once

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// Returns an icosahedron whose edges are halved `subdivisions` times, with all vertices at
// `radius_m` (m) from the origin. It has 20 * 4^subdivisions triangles, wound counter-clockwise
// seen from outside.
TriangleMesh icosphere(double radius_m, int subdivisions);

}  // namespace tactus::host
