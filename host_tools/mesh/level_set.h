// A triangle mesh of where a function is zero, for pictures of surfaces that have none.
#pragma once

#include <functional>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// Metres, world frame; below 0 inside.
using LevelFunction = std::function<double(const Vec3& p_W)>;

// The box is cut into `cells` parts along each side, each part into six tetrahedra, and each
// tetrahedron by a plane (Payne and Toga, "Surface mapping brain function on 3D models", IEEE CG&A
// 10(5), 1990). Every vertex lies on the surface, to 1/4096 of a part's edge. Fronts look to where
// the function is positive. What is finer than a part is lost; a surface that leaves the box ends
// there. Empty if the function has no zero in the box.
TriangleMesh mesh_level_set(const LevelFunction& function, const Vec3& lower_W, const Vec3& upper_W,
                            int cells);

}  // namespace tactus::host
