// The path of the benchmark's tool over any mesh: it presses, strokes and leaves.
#pragma once

#include <cstddef>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// How fast the felt surface may rise or fall where the path jumps from one part of the mesh to the
// next: the speed of a fast hand.
inline constexpr double kMostRise_m_per_s = 1.0;

// Returns one tool position a tick of 1 ms, world frame, m. A ray from outside towards the middle
// of the mesh turns at 2 rad/s about z and nods; the tool presses 1 to 3 mm into the surface where
// the ray meets it. Every two seconds it comes from 20 mm above, strokes for a second and a half,
// and leaves. The ray jumps from one part of the mesh to another; the tool then follows at
// kMostRise_m_per_s, deep in the mesh or above it.
std::vector<Vec3> stroke_workload(const rendering::MeshView& mesh, double tool_radius_m,
                                  std::size_t ticks);

}  // namespace tactus::host
