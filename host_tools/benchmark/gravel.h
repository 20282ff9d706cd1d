// The benchmark's mesh with gaps: many balls in one mesh, between which the tool falls and is held
// from several sides.
#pragma once

#include <cstddef>

#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// The number of balls, and the triangles of each.
inline constexpr std::size_t kGravelBalls = 1000;
inline constexpr std::size_t kGravelBallTriangles = 320;

// The limits of the balls' radii.
inline constexpr double kLeastGravelRadius_m = 0.003;
inline constexpr double kLargestGravelRadius_m = 0.005;

// Returns the balls, one after the other, heaped in a cube about the origin. Neighbours touch or
// overlap a little, or leave a gap. The mesh has the same bits everywhere.
TriangleMesh gravel();

}  // namespace tactus::host
