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
// lifts the sphere to the rest height of a plane, by less than the contact margin (would_cycle ends
// the cycles of these), and one that is lengthened (CurvedPath bounds them). A sweep has proved
// every position on the path clear, so the proxy crosses nothing, also when a limit ends the tick.
//
// A tick ends when there is no move to make, because the goal is settled or the planes leave no
// way, after kMaxSubGoals, or when the budget is spent. After the last two the next tick goes on
// from where the proxy is.
#include "rendering/contact/sphere_proxy.h"

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/candidate_sweep.h"
#include "rendering/contact/constraint_memory.h"
#include "rendering/contact/curved_path.h"
#include "rendering/contact/friction_hold.h"
#include "rendering/contact/plane_collection.h"

namespace tactus::rendering {
namespace {

using Gathering = CandidateSet::Gathering;

// Returns the contact with the largest pressure, which the next tick's proxy is carried by; none if
// no plane pushes.
LastContact hardest_contact(const ProxyRest& rest) {
  const std::size_t hardest = rest.hardest();
  if (rest.plane_count == 0 || rest.pressure_m[hardest] <= 0.0) {
    return {};
  }
  const ContactPlane& plane = rest.planes[hardest];
  return {.object = plane.object, .triangle = plane.triangle, .normal_W = rest.normal_W};
}

// Writes a sub-goal to the path that tests and pictures ask for.
void add_point(ProxyPath* path, std::size_t number, const Vec3& p) {
  if (path != nullptr) {
    path->points[number] = p;
    path->count = number + 1;
  }
}

}  // namespace

// The memory of one tick: each sub-goal leaves it to the next.
struct SphereProxy::Memory {
  // The constraints met in this tick; forgotten when the candidates get new numbers.
  ConstraintMemory constraints;
  // The curvature of the path so far.
  CurvedPath path;
  // True once the proxy slipped in this tick: it then slips in the rest of it.
  bool slipped = false;
};

// The end of the next straight move.
struct SphereProxy::SubGoal {
  Vec3 point = Vec3::Zero();
  bool settled = false;     // there is no move: the proxy is where it belongs
  bool lengthened = false;  // by CurvedPath
};

// A sub-goal and the sweep toward it.
struct SphereProxy::Move {
  SubGoal goal;
  SweepResult sweep;  // toward the goal, unless that is settled
};

// The continuation after a step.
enum class SphereProxy::Next : std::uint8_t {
  go_on,  // with the next step
  again,  // with the first step of this sub-goal
  end,    // the tick ends here
};

void SphereProxy::place(const Vec3& p_W) {
  state_ = {.p_W = p_W};
  carried_W_ = Vec3::Zero();
  planes_.clear();
  just_placed_ = true;
  candidate_set_.start_over();
  candidate_set_.move_to(p_W);
}

// The candidates are checked first, with the objects at their new places: those near a moved object
// are not valid any more. Then the proxy is carried.
std::uint32_t SphereProxy::begin_tick(const SceneObjects& scene) {
  candidate_set_.begin_tick(scene);
  if (!scene.anything_moved()) {
    return kTouchClean;
  }
  const Carried carried =
      carry_along(scene, margins_, state_.p_W, state_.last_contact, candidate_set_.left_out());
  carried_W_ += carried.p_W - state_.p_W;
  if (carried.p_W != state_.p_W) {
    state_.p_W = carried.p_W;
    candidate_set_.move_to(state_.p_W);
  }
  return carried.flags;
}

// A proxy that is carried does not slide over the object that carries it, so friction sees the
// tool's step without it.
void SphereProxy::begin_friction(const Vec3& tool_step_W, double tick_s) {
  state_.model.begin_tick(tool_step_W - carried_W_, tick_s);
  carried_W_ = Vec3::Zero();
}

ProxyRest SphereProxy::advance(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  start_ = state_;
  candidate_set_.start_tick_budget();
  update_left_out(scene);
  return approach(scene, h_W, path);
}

// The candidates stay, with the tangents of their measurements, so a repetition costs less than the
// first advance; its distances are measured again.
ProxyRest SphereProxy::advance_again(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  state_ = start_;
  candidate_set_.move_to(state_.p_W);
  candidate_set_.budget().allow_repeat();
  return approach(scene, h_W, path);
}

ProxyRest SphereProxy::approach(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  ProxyRest rest = run_sub_goals(scene, h_W, path);
  // A tick that ended in the middle of its path may have no plane, yet the surface still pushes the
  // hand.
  constexpr std::uint32_t kUnfinished = kTouchIterationsExhausted | kTouchCandidatesOverflow;
  if (rest.plane_count == 0 && (rest.flags & kUnfinished) != 0) {
    keep_last_contact(scene, state_.last_contact, state_.p_W, h_W, rest);
  }
  state_.last_contact = hardest_contact(rest);
  rest.flags |= candidate_set_.left_out().any() ? kTouchOverlap : kTouchClean;
  return rest;
}

ProxyRest SphereProxy::run_sub_goals(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  const NearbySurfaces near{.scene = scene, .margins = margins_, .candidates = candidate_set_};
  Memory memory;
  ProxyRest rest;
  // An overlap, which rounding or a deformation leaves, is pushed out by the first sub-goal only:
  // afterwards the proxy's own moves keep it clear.
  double max_push_m = kMaxPushOut_m;
  for (;;) {
    add_point(path, rest.sub_goals, state_.p_W);
    Next next = gather(near, h_W, path, memory, rest);
    if (next == Next::go_on) {
      next = collect_planes(near, max_push_m, memory, rest);
    }
    if (next == Next::again) {
      continue;
    }
    if (next == Next::end) {
      return rest;
    }
    const Move move = find_move(near, h_W, max_push_m, memory, rest);
    if (!may_move(near, h_W, move, rest)) {
      return rest;
    }
    make_move(move, memory, rest);
    if (stays_on_face(near, move, memory, rest)) {
      add_point(path, rest.sub_goals, state_.p_W);
      return rest;
    }
    max_push_m = 0.0;
  }
}

// Makes the candidate set valid at the proxy.
SphereProxy::Next SphereProxy::gather(const NearbySurfaces& near, const Vec3& h_W, ProxyPath* path,
                                      Memory& memory, ProxyRest& rest) {
  const std::size_t before = candidate_set_.gatherings();
  const Gathering gathering = candidate_set_.ensure(near.scene, margins_, state_.p_W);
  // A gathering gives the candidates new numbers, and the memory holds numbers.
  if (rest.sub_goals == 0 || candidate_set_.gatherings() != before) {
    memory.constraints.clear();
  }
  if (gathering == Gathering::complete) {
    return Next::go_on;
  }
  if (gathering == Gathering::begun) {
    rest.flags |= kTouchIterationsExhausted;
    // The planes that held the proxy before give the force.
    find_active_constraints(near.scene, factors_, state_.p_W, h_W, planes_, rest);
    return Next::end;
  }
  rest.flags |= kTouchCandidatesOverflow;
  if (gathering == Gathering::smaller) {
    return Next::go_on;
  }
  // Too many triangles come near even in the smallest capsule. Those of an object that the proxy
  // overlaps do not count: it is left out, and the sub-goal begins again.
  if (leave_out_overlapped(near.scene, rest)) {
    return Next::again;
  }
  if (rest.sub_goals < kMaxSubGoals) {
    sweep_to_tool(near, h_W);
    add_point(path, ++rest.sub_goals, state_.p_W);
  }
  return Next::end;
}

// Collects the planes at the proxy.
SphereProxy::Next SphereProxy::collect_planes(const NearbySurfaces& near, double max_push_m,
                                              const Memory& memory, ProxyRest& rest) {
  // The planes of the sub-goal before are about to be replaced. If this one ends early their
  // contact still gives the force.
  if (rest.plane_count > 0) {
    state_.last_contact = hardest_contact(rest);
  }
  PlaneCollector collector(near, state_.p_W, max_push_m);
  switch (collector.collect(memory.constraints, planes_, rest.flags)) {
    case PlaneCollector::Result::unfinished:
      rest.flags |= kTouchIterationsExhausted;
      rest.plane_count = 0;
      return Next::end;
    case PlaneCollector::Result::overlapped:
      forget_left_out(rest);
      return Next::again;
    case PlaneCollector::Result::complete:
      break;
  }
  // The sphere has moved past the end of the face that held it.
  if (rest.plane_count > 0 && planes_.empty()) {
    collector.add_face_below(planes_, rest.flags);
  }
  return Next::go_on;
}

// Chooses the next sub-goal and sweeps to it. A candidate that blocks the sweep at its start adds
// its plane, and the choice is repeated: most edges and vertices give their planes in this manner.
//
// A goal that would begin a cycle is chosen again with the planes that held the proxy at the place
// it has left, which bound it from any distance. The loop ends after kMaxContactPlanes + 1 sweeps.
SphereProxy::Move SphereProxy::find_move(const NearbySurfaces& near, const Vec3& h_W,
                                         double max_push_m, Memory& memory, ProxyRest& rest) {
  const Vec3& p = state_.p_W;
  PlaneCollector collector(near, p, max_push_m);
  Move move;
  std::size_t sweeps = 0;
  do {
    move.goal = choose_goal(near, h_W, memory, rest);
    const SubGoal& goal = move.goal;
    if (!goal.settled && !goal.lengthened && memory.constraints.would_cycle(p, goal.point, h_W) &&
        memory.constraints.recall(planes_)) {
      collector.add_recalled(memory.constraints, planes_, rest.flags);
      move.goal = choose_goal(near, h_W, memory, rest);
    }
    if (goal.settled) {
      break;
    }
    move.sweep = sweep_toward(near, p, goal.point, rest, memory.constraints);
    if (const FirstHit& hit = move.sweep.beyond; hit.object != kNoObject) {
      // The contact of this tick, should it end before the object is measured there.
      state_.last_contact = {.object = hit.object, .triangle = hit.triangle};
    }
  } while (++sweeps <= kMaxContactPlanes && move.sweep.blocked_by != kNoCandidate &&
           collector.add_blocking(move.sweep.blocked_by, planes_, rest.flags));
  return move;
}

// Projects the tool on the planes, holds the proxy by friction and lengthens the move on a curved
// path. A move below kSettled_m is none.
SphereProxy::SubGoal SphereProxy::choose_goal(const NearbySurfaces& near, const Vec3& h_W,
                                              Memory& memory, ProxyRest& rest) {
  const Vec3& p = state_.p_W;
  const ActiveConstraints active =
      find_active_constraints(near.scene, factors_, p, h_W, planes_, rest);
  if (active.projection.active_count == 0) {
    const bool arrived = (h_W - p).squaredNorm() <= 0.0;
    if (arrived) {
      state_.friction = FrictionState::free;
    }
    return {.point = h_W, .settled = arrived};
  }
  const HeldGoal held =
      hold_by_friction(near.scene, active, rest, h_W, planes_, state_, memory.slipped);
  if (held.sticks) {
    return {.point = held.point, .settled = held.settled};
  }
  const Vec3 move = held.point - p;
  if (move.norm() <= kSettled_m) {
    return {.point = p, .settled = true};
  }
  const Candidate& first = near.candidates.candidate(rest.planes[0].candidate);
  const Vec3 lengthened = memory.path.lengthen(move, p, held.tool, rest, planes_, first.triangle);
  return {.point = p + lengthened, .lengthened = lengthened != move};
}

// Returns true if the tick goes on with this move. A tick whose budget is spent still makes its
// first move if the proxy has waited, so that no place can hold it for ever.
bool SphereProxy::may_move(const NearbySurfaces& near, const Vec3& h_W, const Move& move,
                           ProxyRest& rest) {
  if (move.goal.settled) {
    return false;
  }
  const bool is_free = move.sweep.travel_m > 0.0;
  const bool must_move = rest.sub_goals == 0 && is_free && candidate_set_.has_waited();
  if (rest.sub_goals == kMaxSubGoals || (candidate_set_.budget().is_exhausted() && !must_move)) {
    rest.flags |= kTouchIterationsExhausted;
    return false;
  }
  // The planes leave no free direction. If more planes hold the proxy than are kept, the missing
  // ones may be the reason.
  if (!is_free) {
    escape_overfull_planes(near, h_W, rest);
  }
  return is_free;
}

// Makes the move and leaves what the next sub-goal needs: the constraints that held the proxy here
// (not those of a lengthened move, which leaves them behind), the move along a crease, and the
// position from which candidates are measured.
void SphereProxy::make_move(const Move& move, Memory& memory, ProxyRest& rest) {
  const auto& [goal, sweep] = move;
  Vec3& p = state_.p_W;
  memory.constraints.leave(p, rest, goal.lengthened ? std::size_t{0} : rest.plane_count);
  if (rest.plane_count == 2) {
    memory.path.remember_crease(goal.lengthened ? Vec3{Vec3::Zero()} : Vec3{goal.point - p});
  }
  p = sweep.arrived ? goal.point : Vec3{p + sweep.travel_m * sweep.direction};
  if (sweep.is_known) {
    candidate_set_.move_to_end(p);
  } else {
    candidate_set_.move_to(p);
  }
  ++rest.sub_goals;
  candidate_set_.budget().spend(kCostOfSubGoal);
}

// Returns true if the proxy has come to rest on the face that held it before the move, and sets
// its distance. The test is not made after a tick's first move: on small triangles it mostly fails,
// and it would cost more than it saves.
bool SphereProxy::stays_on_face(const NearbySurfaces& near, const Move& move, const Memory& memory,
                                ProxyRest& rest) const {
  const bool may_stay = move.sweep.is_known && !move.goal.lengthened && rest.sub_goals > 1;
  if (!may_stay || !is_still_on_face(near, state_.p_W, memory.constraints, rest)) {
    return false;
  }
  Nearest& nearest = rest.planes[0].nearest;
  nearest.distance += nearest.normal.dot(state_.p_W - memory.constraints.left_from());
  return true;
}

// Needs no candidates: the sweep goes through the hierarchies, within kMaxCarryBudget.
void SphereProxy::sweep_to_tool(const NearbySurfaces& near, const Vec3& h_W) {
  Vec3& p = state_.p_W;
  const Vec3 move = h_W - p;
  const double length = move.norm();
  if (length <= 0.0) {
    state_.friction = FrictionState::free;
    return;
  }
  const Sweep sweep{.from = p, .direction = move / length};
  const FirstHit hit = sweep_beyond_candidates(near, sweep, length, kMaxCarryBudget);
  if (hit.object != kNoObject) {
    state_.last_contact = {.object = hit.object, .triangle = hit.triangle};
  }
  if (hit.travel_m > 0.0) {
    p = hit.travel_m >= length ? h_W : Vec3{p + hit.travel_m * sweep.direction};
    candidate_set_.move_to(p);
  }
}

void SphereProxy::escape_overfull_planes(const NearbySurfaces& near, const Vec3& h_W,
                                         ProxyRest& rest) {
  if ((rest.flags & kTouchPlanesOverflow) == 0 || rest.sub_goals > 0) {
    return;
  }
  sweep_to_tool(near, h_W);
  if (state_.p_W == h_W) {
    rest.plane_count = 0;
    rest.normal_W = Vec3::Zero();
    state_.friction = FrictionState::free;
  }
}

void SphereProxy::update_left_out(const SceneObjects& scene) {
  // A placed proxy overlaps what is nearer than the margin's `inner_m` by this, m.
  constexpr double kNoOverlap_m = 0.5e-6;  // within the contact margin
  LeftOut& left_out = candidate_set_.left_out();
  bool changed = false;
  if (just_placed_) {
    changed = left_out.add_overlapped(scene, margins_, state_.p_W, kNoOverlap_m);
    just_placed_ = false;
  } else if (left_out.any()) {
    changed = left_out.take_back(scene, margins_, state_.p_W);
  }
  if (changed) {
    candidate_set_.clear();
  }
}

// Leaves out the objects that the proxy overlaps by more than kMaxPushOut_m. Returns true if there
// were any.
bool SphereProxy::leave_out_overlapped(const SceneObjects& scene, ProxyRest& rest) {
  if (!candidate_set_.left_out().add_overlapped(scene, margins_, state_.p_W, kMaxPushOut_m)) {
    return false;
  }
  forget_left_out(rest);
  return true;
}

// Removes every trace of the objects that are left out now: their planes, their contact, their
// candidates.
void SphereProxy::forget_left_out(ProxyRest& rest) {
  rest.plane_count = 0;
  planes_.clear();
  LastContact& last = state_.last_contact;
  if (last.object != kNoObject && candidate_set_.left_out().has(last.object)) {
    last = {};
  }
  candidate_set_.clear();
}

}  // namespace tactus::rendering
