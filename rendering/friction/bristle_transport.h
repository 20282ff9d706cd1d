// Transports the bristle with the contact: round a corner, and from one surface to the next.
#pragma once

#include <cmath>

#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns `tangent`, which is perpendicular to the unit normal `from`, turned by the least rotation
// that takes `from` to the unit normal `to`. The length stays, to rounding. On tangent vectors this
// rotation is the mirror image in the plane perpendicular to h = from + to. Opposite normals have
// no least rotation: the one about the tangent itself is used, also where h is mostly rounding.
inline Vec3 turned(const Vec3& tangent, const Vec3& from, const Vec3& to) {
  constexpr double kOpposite = 1e-16;  // |h|^2: 1e-8 rad
  const Vec3 half = from + to;
  const double squared = half.squaredNorm();
  const double twice = squared > kOpposite ? 2.0 * half.dot(tangent) / squared : 0.0;
  const Vec3 there = tangent - twice * half;
  return there - to.dot(there) * to;
}

// Changes the stiffness of a contact that goes on (0: rigid). The force stays if that adds no
// energy; otherwise it is lowered to keep the energy.
template <typename Vector>
void change_stiffness(FrictionMemory<Vector>& memory, double old_N_per_m, double new_N_per_m) {
  const bool was_rigid = old_N_per_m <= 0.0;
  const bool is_softer = new_N_per_m > 0.0 && (was_rigid || new_N_per_m < old_N_per_m);
  if (is_softer) {
    const double share = was_rigid ? 0.0 : std::sqrt(new_N_per_m / old_N_per_m);
    memory.elastic_force_N *= share;
  }
}

}  // namespace tactus::rendering
