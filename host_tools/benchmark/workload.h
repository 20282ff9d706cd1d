// The path of the benchmark's tool over any mesh: it presses, strokes and leaves.
#pragma once

#include <cstddef>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// How fast the surface under the tool may come and go, from one part of the mesh to the next: the
// speed of a fast hand.
inline constexpr double kMostRise_m_per_s = 1.0;

// One tool position a tick, 1 kHz, world frame, metres. The direction from the mesh's middle turns
// at 2 rad/s about z and nods; along it the surface is found by a ray from outside; the tool's
// surface is pressed 1 to 3 mm into it. Every two seconds the tool comes from 20 mm above, strokes
// for a second and a half, and leaves. Where the ray jumps from one part of the mesh to another,
// the tool follows at kMostRise_m_per_s, deep in the mesh or above it.
std::vector<Vec3> stroke_workload(const rendering::MeshView& mesh, double tool_radius_m,
                                  std::size_t ticks);

}  // namespace tactus::host
