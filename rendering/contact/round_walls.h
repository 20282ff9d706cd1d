// Leads the proxy along the round walls of the primitives that it touches from the hollow side:
// within a hollow solid, in the hole of a torus. It belongs to the fourth step of a sub-goal
// (proxy_tick.cpp).
//
// A contact plane touches a wall at the proxy. Where the wall is hollow, a goal on that plane lies
// beyond it, so a move toward the goal ends after a few micrometres, and hundreds of moves follow
// the wall. This file puts the goal on the wall itself. The sweep proves the way there free, as
// every other.
#pragma once

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/friction_hold.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// Returns true if the proxy may be on the hollow side of a wall of the candidate.
inline bool may_be_hollow(const Candidate& candidate) {
  return candidate.primitive != nullptr &&
         (candidate.seen.distance_m < 0.0 || !convex(*candidate.primitive));
}

// Returns true if such a wall gave one of the active planes of `rest`.
inline bool touches_round_wall(const CandidateSet& candidates, const ProxyRest& rest) {
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    if (may_be_hollow(candidates.candidate(rest.planes[i].candidate))) {
      return true;
    }
  }
  return false;
}

// The proxy p with its contact planes and the active ones among them; world frame, m.
struct ProxyAtWalls {
  const NearbySurfaces& near;
  const ContactPlanes& planes;
  const ProxyRest& rest;
  const Vec3& p;
};

// Returns the goal on the walls for the one on the contact planes, `held.point`; the same where no
// wall is hollow. The friction circle draws it back from `pulled_to`, which is `held.point` without
// one. World frame, m.
Vec3 goal_on_walls(const ProxyAtWalls& at, const Vec3& pulled_to, const HeldGoal& held);

}  // namespace tactus::rendering
