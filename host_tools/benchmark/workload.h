// The paths of the benchmark's tool over any mesh: it presses, strokes and leaves.
#pragma once

#include <cstddef>
#include <span>
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

// The limits of a hand: the speed of a fast stroke, and how far a device lets it stretch the proxy.
inline constexpr double kHandSpeed_m_per_s = 0.5;
inline constexpr double kHandStretch_m = 0.01;

// Returns the path of a hand that follows `wishes` (one a tick of 1 ms, world frame, m) over the
// object: no faster than kHandSpeed_m_per_s, and nowhere farther than kHandStretch_m from the proxy
// of a tick without a limit on its budget.
std::vector<Vec3> hand_workload(const rendering::Object& object, double tool_radius_m,
                                std::span<const Vec3> wishes);

}  // namespace tactus::host
