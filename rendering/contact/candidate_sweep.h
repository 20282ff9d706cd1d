// Sweeps the sphere from the proxy to the sub-goal, and finds the candidate that blocks it. It is
// the last step of a sub-goal (proxy_tick.cpp).
//
// A distance is convex along the segment, so a candidate that the tangent at the start shows out of
// reach at the end is out of reach all along. Most of the others lie behind the planes that hold
// the sphere, on a convex surface all of them. The candidates near the start are swept first: in a
// hollow they block the sphere soon, and few of the rest are within reach of there.
#pragma once

#include <cstddef>

#include "rendering/contact/constraint_memory.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/contact/object_sweep.h"
#include "rendering/contact/proxy_rest.h"

namespace tactus::rendering {

// The result of a sweep: the sphere may move along `direction` by `travel_m`.
struct SweepResult {
  // The unit vector from the proxy to the goal; world frame.
  Vec3 direction = Vec3::Zero();
  double travel_m = 0.0;
  // True if the whole segment is free.
  bool arrived = false;
  // True if the segment is free and the candidates are valid at its end.
  bool is_known = false;
  // The candidate that blocks the sphere at its start, kNoCandidate if none does.
  std::size_t blocked_by = kNoCandidate;
  // The candidate at which the free part ends, kNoCandidate if none shortens it.
  std::size_t ends_at = kNoCandidate;
  // The object that blocks it beyond the candidate set; its `object` is kNoObject if none does.
  FirstHit beyond;
};

// Returns how far the sphere may move from the proxy `p` to `goal` (world frame, m; not the same
// point). `rest` has the planes that hold the proxy. A move that leaves the trusted capsule is cut
// at its border, where the candidate set is gathered again. One that leaves even a fresh capsule is
// swept against the hierarchies, as far as that is cheap. A candidate that stops the sphere is
// added to `memory`. If the tick's budget is spent before the end is known, the travel is 0.
SweepResult sweep_toward(const NearbySurfaces& near, const Vec3& p, const Vec3& goal,
                         const ProxyRest& rest, ConstraintMemory& memory);

// Sweeps against all objects for at most `max_cost` cost units, which the tick's budget pays.
FirstHit sweep_beyond_candidates(const NearbySurfaces& near, const Sweep& sweep, double length_m,
                                 std::size_t max_cost);

}  // namespace tactus::rendering
