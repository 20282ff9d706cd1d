// The spring of a corner whose surfaces have different stiffnesses. Its force is the gradient of
// one potential, so that no closed path of the tool gives out energy.
//
// The stretch of the proxy is s = sum_i pressure_i n_i + t: its part over the active planes, and
// the lag t along all of them, by which friction holds the proxy. The potential is
//
//   V = 1/2 K s^2,   K = (sum_i K_i pressure_i^2) / (sum_i pressure_i^2)
//
// On one plane, and between surfaces of one stiffness, it is the spring of the god-object (Zilles
// and Salisbury, IROS 1995). In a corner of walls at right angles it is the sum of the walls' own
// springs, 1/2 K_i pressure_i^2. V and its gradient go continuously into those of the plane that
// remains when the other of two lets go; between two and three planes V does. The force is
//
//   F = dV/ds = K s + 1/2 s^2 dK/ds
//
// A plane whose spring is not linear (unpressed_depth.h) has the K_i of the linear spring with the
// same energy, 1/2 K_i pressure_i^2; dK/ds has the rest of its force.
//
// The second part pushes across s, toward the softer surface: the tool's energy is less there.
// Between normals that are nearly parallel, or nearly opposite, it would make the corner stiffer
// than any device can hold, the more the longer the lag is. It is lessened there, so that it adds
// no more than about the hardest surface's stiffness; a closed path can then give out energy.
// Without friction it is whole between normals 60 to 135 degrees apart if the hardest surface is at
// most twenty times as stiff as the softest; between normals at right angles it is so up to a lag
// of the length of the stretch over the planes.
#pragma once

#include <array>

#include "rendering/contact/proxy_rest.h"
#include "rendering/contact/unpressed_depth.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The longest lag in a corner, in lengths of the stretch over its planes. A cone of a friction of 1
// holds no longer one; viscous friction may.
inline constexpr double kMostLag = 1.5;

struct CornerSpring {
  // K, N/m; 0 if no plane is active.
  double stiffness_N_per_m = 0.0;
  // The second part of the force on the tool, world frame, N.
  Vec3 sideways_W = Vec3::Zero();
};

// Returns the spring of the active planes; springs[i] is that of plane i. `stretch_W` is
// the vector from the tool to the proxy, m, which has the lag; without it there is none. A lag
// counts up to kMostLag times the stretch over the planes.
CornerSpring corner_spring(const ProxyRest& rest, const std::array<PlaneSpring, 3>& springs,
                           const Vec3& stretch_W = Vec3::Zero());

}  // namespace tactus::rendering
