// A goal that would begin a cycle is chosen again with the recalled planes, and one whose sweep is
// blocked at its start with the plane of the candidate that blocks it: most edges and vertices give
// their planes in this manner. The recalled planes are those that held the proxy at the place it
// has left; they bound it from any distance. A proxy that rubs, and meets a seam only because it is
// below its rest height, rises first.
#include "rendering/contact/next_move.h"

#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {

// The loop ends after kMaxContactPlanes + 1 sweeps.
template <class Watch>
NextMove MoveFinder::find(const ProxyMove& tick, const MovingProxy& proxy,
                          PlaneCollector& collector, bool is_stalling, Watch watch) {
  auto& [state, planes, rest] = proxy;
  const Vec3& p = state.p_W;
  NextMove move;
  std::size_t sweeps = 0;
  bool has_recalled = false;
  for (;;) {
    move.goal = sub_goals_.choose(tick, proxy);
    watch.see_step(TickStep::proxy);
    const SubGoal& goal = move.goal;
    if (!has_recalled && !goal.settled && !goal.lengthened &&
        (constraints_.would_cycle(p, goal.point, tick.h_W) || is_stalling) &&
        constraints_.recall(planes)) {
      has_recalled = true;
      collector.add_recalled(constraints_, planes, rest.flags);
      continue;
    }
    has_recalled = false;
    if (goal.settled) {
      return move;
    }
    move.sweep = sweep_toward(tick.near, p, goal.point, rest, constraints_);
    watch.see_step(TickStep::collision);
    if (const FirstHit& hit = move.sweep.beyond; hit.object != kNoObject) {
      // The contact of this tick, should it end before the object is measured there.
      state.last_contact = {.object = hit.object, .triangle = hit.triangle};
    }
    const std::size_t blocked_by = move.sweep.blocked_by;
    if (++sweeps > kMaxContactPlanes || blocked_by == kNoCandidate) {
      return move;
    }
    if (const auto raised = collector.place_above_seam(blocked_by, planes)) {
      const SweepResult rise = sweep_toward(tick.near, p, *raised, rest, constraints_);
      watch.see_step(TickStep::collision);
      if (rise.arrived) {
        return {.goal = {.point = *raised, .tool = goal.tool}, .sweep = rise};
      }
    }
    if (!collector.add_blocking(blocked_by, planes, rest.flags)) {
      return move;
    }
  }
}

template NextMove MoveFinder::find(const ProxyMove&, const MovingProxy&, PlaneCollector&, bool,
                                   Unwatched);
template NextMove MoveFinder::find(const ProxyMove&, const MovingProxy&, PlaneCollector&, bool,
                                   Watched);

}  // namespace tactus::rendering
