// Closes small holes of a mesh with triangles. A step of mesh_bake.h.
#pragma once

#include <cstddef>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// The holes that were closed.
struct HoleCaps {
  std::size_t holes = 0;
  std::size_t triangles = 0;
};

// Closes every loop of open edges whose size (open_loops.h) is at most `most_m`. It cuts ears off
// the loop as seen along its own normal; where none is left, a fan from a new vertex closes the
// rest. The new triangles face the way of their neighbours and have their texture places. Throws
// InputError, without a file name and with the hole's place, if a hole is so crooked that neither
// closes it.
HoleCaps cap_holes(TriangleMesh& mesh, double most_m);

}  // namespace tactus::host
