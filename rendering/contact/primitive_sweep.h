// Sweeps a sphere along a straight line against a primitive, as sphere_sweep.h does against a
// triangle. The candidate sweep and the object sweep use it.
#pragma once

#include <cmath>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/geometry/mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// Returns the nearest point as for a triangle: the normal points to the side of the sample.
inline Nearest nearest_of(const SurfaceSample& seen) {
  return {.distance = std::abs(seen.distance_m),
          .normal = seen.distance_m < 0.0 ? Vec3{-seen.normal_W} : seen.normal_W};
}

// Returns the travel, in metres, at which the sphere's centre enters the contact margin of the
// surface, or `limit` if it does not enter before. The result is never too long, and too short by
// less than the margin's thickness.
//
// A one-sided primitive is solid: a sphere that starts with its centre inside may leave, and is
// blocked again by what it then stands clear of (the other side of a torus). A two-sided primitive
// is a hollow skin, and the sphere stays on its side. A sphere that starts below `inner_m` may move
// out and along the surface, not deeper.
//
// `start` is sample(primitive, sweep.from). `limit` is >= 0 and finite.
double travel_to_contact(const Primitive& primitive, Sides sides, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const SurfaceSample& start);

}  // namespace tactus::rendering
