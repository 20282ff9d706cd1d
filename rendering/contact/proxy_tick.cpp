// The proxy is the centre of a sphere that must stay clear of every triangle, as near to the tool
// as possible. One tick is a sequence of sub-goals. Each of them takes these steps:
//
//   1. gather: make the candidate set valid at the proxy (candidate_set.h);
//   2. collect planes: every triangle in contact gives a plane through the proxy, normal to the
//      line from its nearest point. A triangle is convex and lies behind that plane, so no move on
//      the plane's positive side can touch it (plane_collection.h);
//   3. project: find the point nearest to the tool in front of all planes. At most three of them
//      are active (active_constraints.h);
//   4. hold by friction: draw that point back to the friction circle (friction_hold.h). On a curved
//      path the move is lengthened (curved_path.h);
//   5. sweep: move the sphere straight to that sub-goal, or to the first triangle that gave no
//      plane yet (candidate_sweep.h).
//
// SubGoalChooser takes steps 3 and 4 (sub_goal.h). MoveFinder repeats them with step 5 while the
// sweep meets new planes (next_move.h).
//
// With the proxy p, the tool h and the planes n_i . x >= d_i, step 3 is the quadratic program of
// Zilles and Salisbury (IROS 1995):
//
//   minimise |x - h|^2 subject to n_i . x >= d_i,   x = h + sum_i pressure_i n_i
//
// Its multipliers are the pressures: lengths, of which each, times the stiffness, is the force on
// one plane, and whose sum is the normal force that friction sees.
//
// The tool's projection on planes through the proxy is nearer to the tool than the proxy, and so is
// every point on the segment to it. Each move shortens the distance to the tool, so the proxy
// cannot cycle, and it ends at a local minimum of that distance. Two moves are exceptions: one that
// lifts the sphere to the rest height of a plane, by less than the contact margin, and one that is
// lengthened (CurvedPath bounds them). The former can make cycles: would_cycle ends those of two
// places, and Descent proves that no other one lasts (descent.h). A sweep has proved
// every position on the path clear, so the proxy crosses nothing, also when a limit ends the tick.
//
// A tick ends when there is no move to make, because the goal is settled, the descent is over (both
// in tick_end.h) or the planes leave no free direction, after kMaxSubGoals, or when the budget is
// spent. After the last two the next tick goes on from where the proxy is. Among too many
// candidates or planes the proxy moves straight to the tool (straight_escape.h).
#include "rendering/contact/proxy_tick.h"

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/next_move.h"
#include "rendering/contact/plane_collection.h"
#include "rendering/contact/straight_escape.h"
#include "rendering/contact/tick_end.h"
#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {
namespace {

using Gathering = CandidateSet::Gathering;

// The continuation after a step.
enum class Next : std::uint8_t {
  go_on,  // with the next step, and after the last one with the next sub-goal
  again,  // with the first step of this sub-goal
  end,    // the tick ends here
};

// The moves of one tick, which `Watch` sees (tick_watch.h). All of it is compiled for each kind:
// functions that two kinds call would not be inlined.
template <class Watch>
class ProxyTick {
 public:
  ProxyTick(const ProxyMove& tick, const MovingProxy& proxy, Watch watch)
      : tick_(tick), near_(tick.near), proxy_(proxy), watch_(watch), end_(proxy.state, tick.h_W) {
    proxy.state.is_settled = false;
  }

  void run();

 private:
  // Takes the steps of one sub-goal. An overlapping proxy is pushed out by at most `max_push_m`.
  Next take_sub_goal(double max_push_m);

  // The parts of a sub-goal, in their order: gather makes the candidate set valid; collect_planes
  // finds the contact planes; MoveFinder chooses the goal and sweeps; judge finds out that the
  // proxy has settled; may_move asks the limits; make_move moves the proxy; stays_on_face finds out
  // cheaply that the tick is over.
  Next gather();
  Next collect_planes(PlaneCollector& collector);
  Next judge(const SubGoal& goal);
  bool may_move(const NextMove& move);
  void make_move(const NextMove& move);
  bool stays_on_face(const NextMove& move);

  void end_short_of(const Vec3& goal_W);
  void forget_left_out();

  const ProxyMove& tick_;
  const NearbySurfaces& near_;
  const MovingProxy proxy_;
  [[no_unique_address]] const Watch watch_;
  MoveFinder moves_;
  TickEnd end_;
};

// An overlap, which rounding or a deformation leaves, is pushed out by the first sub-goal only:
// afterwards the proxy's own moves keep it clear.
template <class Watch>
void ProxyTick<Watch>::run() {
  double max_push_m = kMaxPushOut_m;
  for (Next next = Next::again; next != Next::end;) {
    next = take_sub_goal(max_push_m);
    if (next == Next::go_on) {
      max_push_m = 0.0;
    }
  }
  watch_.see_end(proxy_, end_.has_gone_back());
}

template <class Watch>
Next ProxyTick<Watch>::take_sub_goal(double max_push_m) {
  if (const Next next = gather(); next != Next::go_on) {
    return next;
  }
  PlaneCollector collector(near_, proxy_.state.p_W, max_push_m);
  if (const Next next = collect_planes(collector); next != Next::go_on) {
    return next;
  }
  watch_.see_step(TickStep::collision);
  const NextMove move = moves_.find(tick_, proxy_, collector, end_.is_stalling(), watch_);
  watch_.see({tick_, proxy_, move, end_.has_gone_back()});
  if (const Next next = judge(move.goal); next != Next::go_on) {
    return next;
  }
  if (!may_move(move)) {
    return Next::end;
  }
  make_move(move);
  if (!stays_on_face(move)) {
    return Next::go_on;
  }
  end_.settle(tick_.h_W, proxy_.state);
  return Next::end;
}

// Makes the candidate set valid at the proxy.
template <class Watch>
Next ProxyTick<Watch>::gather() {
  auto& [state, planes, rest] = proxy_;
  const std::size_t before = near_.candidates.gatherings();
  const Gathering gathering = near_.candidates.ensure(near_.scene, near_.margins, state.p_W);
  // A gathering gives the candidates new numbers, and the memory holds numbers.
  if (rest.sub_goals == 0 || near_.candidates.gatherings() != before) {
    moves_.forget_candidates();
  }
  if (gathering == Gathering::complete) {
    return Next::go_on;
  }
  if (gathering == Gathering::begun) {
    end_short_of(tick_.h_W);
    // The planes that held the proxy before give the force.
    find_active_constraints(near_.scene, tick_.factors, state, tick_.h_W, planes, rest);
    return Next::end;
  }
  rest.flags |= kTouchCandidatesOverflow;
  // Too many triangles come near even in the smallest capsule. Those of an object that the proxy
  // overlaps do not count: it is left out, and the sub-goal begins again.
  if (near_.candidates.left_out().add_overlapped(near_.scene, near_.margins, state.p_W,
                                                 kMaxPushOut_m)) {
    forget_left_out();
    return Next::again;
  }
  if (rest.sub_goals < kMaxSubGoals) {
    sweep_to_tool(near_, tick_.h_W, state);
    ++rest.sub_goals;
  }
  return Next::end;
}

// Collects the planes at the proxy.
template <class Watch>
Next ProxyTick<Watch>::collect_planes(PlaneCollector& collector) {
  auto& [state, planes, rest] = proxy_;
  // The planes of the sub-goal before are about to be replaced. If this one ends early their
  // contact still gives the force.
  if (rest.plane_count > 0) {
    state.last_contact = hardest_contact(rest);
  }
  const bool rubs = rest.sub_goals == 0 && state.friction != FrictionState::free;
  switch (collector.collect(moves_.constraints(), rubs ? state.held_by : HeldBy{}, planes,
                            rest.flags)) {
    case PlaneCollector::Result::unfinished:
      end_short_of(tick_.h_W);
      rest.plane_count = 0;
      return Next::end;
    case PlaneCollector::Result::overlapped:
      forget_left_out();
      return Next::again;
    case PlaneCollector::Result::complete:
      break;
  }
  // The sphere has moved past the end of the face that held it.
  if (rest.plane_count > 0 && planes.empty()) {
    collector.add_face_below(planes, rest.flags);
  }
  return Next::go_on;
}

// Ends the tick if the proxy has settled. A proxy that was put back is measured from there.
template <class Watch>
Next ProxyTick<Watch>::judge(const SubGoal& goal) {
  switch (end_.judge(goal, tick_.h_W, proxy_)) {
    case TickEnd::Verdict::settled:
      return Next::end;
    case TickEnd::Verdict::gone_back:
      near_.candidates.move_to(proxy_.state.p_W);
      return Next::again;
    case TickEnd::Verdict::go_on:
      break;
  }
  return Next::go_on;
}

// Returns true if the tick goes on with this move. A tick whose budget is spent still makes its
// first move if the proxy has waited, so that no place can hold it for ever.
template <class Watch>
bool ProxyTick<Watch>::may_move(const NextMove& move) {
  const std::uint16_t sub_goals = proxy_.rest.sub_goals;
  const bool is_free = move.sweep.travel_m > 0.0;
  const bool must_move = sub_goals == 0 && is_free && near_.candidates.has_waited();
  if (sub_goals == kMaxSubGoals || (near_.candidates.budget().is_exhausted() && !must_move)) {
    end_short_of(move.goal.point);
    return false;
  }
  // The planes leave no free direction. If more planes hold the proxy than are kept, the missing
  // ones may be the reason.
  if (!is_free) {
    escape_overfull_planes(near_, tick_.h_W, proxy_);
  }
  return is_free;
}

// Makes the move and leaves what the next sub-goal needs: the constraints that held the proxy here,
// and the position from which candidates are measured.
template <class Watch>
void ProxyTick<Watch>::make_move(const NextMove& move) {
  const auto& [goal, sweep] = move;
  Vec3& p = proxy_.state.p_W;
  moves_.leave(p, goal, proxy_.rest);
  p = sweep.arrived ? goal.point : Vec3{p + sweep.travel_m * sweep.direction};
  if (sweep.is_known) {
    near_.candidates.move_to_end(p);
  } else {
    near_.candidates.move_to(p);
  }
  ++proxy_.rest.sub_goals;
  near_.candidates.budget().spend(kCostOfSubGoal);
}

// Returns true if the proxy has come to rest on the face that held it before the move, and sets
// its distance. The test is not made after a tick's first move: on small triangles it mostly fails,
// and it would cost more than it saves.
template <class Watch>
bool ProxyTick<Watch>::stays_on_face(const NextMove& move) {
  const Vec3& p = proxy_.state.p_W;
  ProxyRest& rest = proxy_.rest;
  const ConstraintMemory& constraints = moves_.constraints();
  const bool may_stay = move.sweep.is_known && !move.goal.lengthened && rest.sub_goals > 1;
  if (!may_stay || !is_still_on_face(near_, p, constraints, rest)) {
    return false;
  }
  Nearest& nearest = rest.planes[0].nearest;
  nearest.distance += nearest.normal.dot(p - constraints.left_from());
  return true;
}

// Says that a limit ends the tick before the proxy has reached the goal.
template <class Watch>
void ProxyTick<Watch>::end_short_of(const Vec3& goal_W) {
  proxy_.rest.flags |= kTouchIterationsExhausted;
  proxy_.rest.short_of_goal_m = (goal_W - proxy_.state.p_W).norm();
}

// Removes every trace of the objects that are left out now: their planes, their contact, their
// candidates.
template <class Watch>
void ProxyTick<Watch>::forget_left_out() {
  proxy_.rest.plane_count = 0;
  proxy_.planes.clear();
  LastContact& last = proxy_.state.last_contact;
  if (last.object != kNoObject && near_.candidates.left_out().has(last.object)) {
    last = {};
  }
  near_.candidates.clear();
}

}  // namespace

template <class Watch>
void run_sub_goals(const ProxyMove& tick, const MovingProxy& proxy, Watch watch) {
  ProxyTick(tick, proxy, watch).run();
}

template void run_sub_goals(const ProxyMove&, const MovingProxy&, Unwatched);
template void run_sub_goals(const ProxyMove&, const MovingProxy&, Watched);

}  // namespace tactus::rendering
