// How far a sphere can travel along a straight line before it touches a primitive: what
// sphere_sweep.h is for triangles.
#pragma once

#include <cmath>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/surface/mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// The same as for a triangle: the normal points to the side where the sample was taken.
inline Nearest nearest_of(const SurfaceSample& seen) {
  return {.distance = std::abs(seen.distance_m),
          .normal = seen.distance_m < 0.0 ? Vec3{-seen.normal_W} : seen.normal_W};
}

// Travel in metres at which the sphere's centre enters the contact margin of the surface, or
// `limit` if it does not do so before. Never too long, and too short only by the contact margin's
// thickness.
//
// One-sided, the primitive is solid: a sphere that starts with its centre inside may leave, and is
// stopped again by what it then comes to stand clear of (the other side of a torus). Two-sided, it
// is a hollow skin, and the sphere stays on the side where its centre starts. A sphere that starts
// deeper in the contact margin than `inner` may move out of it and along it, not deeper.
//
// `start` is sample(primitive, sweep.from). `limit` >= 0 and finite.
double travel_to_contact(const Primitive& primitive, Sides sides, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const SurfaceSample& start);

}  // namespace tactus::rendering
