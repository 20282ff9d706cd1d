// Checks that a mesh bounds a solid, so that its volume has a meaning. A step of mass_properties.h.
#pragma once

#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// Throws InputError, without a file name, unless every vertex is finite, every index in range, no
// triangle there twice, and every edge run along as often in one direction as in the other. Edges
// of four and more triangles pass if they are: there solids touch.
void require_solid(std::span<const Vec3> vertices,
                   std::span<const rendering::TriangleIndices> triangles);

}  // namespace tactus::host
