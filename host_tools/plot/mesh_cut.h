// The lines in which a plane cuts a mesh, for figures that show what is inside.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The two ends of a line, m.
using CutLine = std::array<Vec3, 2>;

// Returns one line for each triangle that the plane cuts; `height` gives the signed distance of a
// point from the plane, in any unit. Frame of the mesh.
std::vector<CutLine> cut_lines(const rendering::MeshView& mesh,
                               const std::function<double(const Vec3&)>& height);

}  // namespace tactus::host
