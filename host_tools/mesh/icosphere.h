// Spheres of any fineness: the benchmark's meshes, and the tests'.
#pragma once

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// An icosahedron whose edges are halved `subdivisions` times, vertices on the sphere about the
// origin: 20 * 4^subdivisions triangles, wound counter-clockwise seen from outside.
TriangleMesh icosphere(double radius_m, int subdivisions);

}  // namespace tactus::host
