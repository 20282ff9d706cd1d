// Makes a triangle mesh of a surface that is given as f(p) = 0. The mesh is for pictures of formula
// surfaces, which have none; touching them needs no mesh. Host tools call it, one thread.
#pragma once

#include <functional>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// Returns a value below 0 for points inside the surface. The point is in the world frame, m.
using LevelFunction = std::function<double(const Vec3& p_W)>;

// Returns the surface within a box, by marching tetrahedra: the box is cut into `cells` parts along
// each side, each part into six tetrahedra, and each tetrahedron by a plane (Payne and Toga,
// "Surface mapping brain function on 3D models", IEEE CG&A 10(5), 1990). Every vertex lies on the
// surface, to 1/4096 of the length of the edge that it is on. Triangles face to where the function
// is positive. Details smaller than a part are lost, and a surface that leaves the box is cut
// there. The mesh is empty if the function has no zero in the box. Both corners are in the world
// frame, m.
TriangleMesh mesh_level_set(const LevelFunction& function, const Vec3& lower_W, const Vec3& upper_W,
                            int cells);

}  // namespace tactus::host
