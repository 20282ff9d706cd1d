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
// lifts the sphere to the rest height of a plane, by less than the contact margin, and one that is
// lengthened (CurvedPath bounds them). The former can make cycles: would_cycle ends those of two
// places, and Descent proves that no other one lasts (descent.h). A sweep has proved
// every position on the path clear, so the proxy crosses nothing, also when a limit ends the tick.
//
// A tick ends when there is no move to make, because the goal is settled, the planes leave no free
// direction or the descent is over, after kMaxSubGoals, or when the budget is spent. After the last
// two the next tick goes on from where the proxy is.
#include "rendering/contact/proxy_tick.h"

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/candidate_sweep.h"
#include "rendering/contact/constraint_memory.h"
#include "rendering/contact/curved_path.h"
#include "rendering/contact/descent.h"
#include "rendering/contact/friction_hold.h"
#include "rendering/contact/plane_collection.h"

namespace tactus::rendering {
namespace {

using Gathering = CandidateSet::Gathering;

// Writes a sub-goal to the path that tests and pictures ask for.
void add_point(ProxyPath* path, std::size_t number, const Vec3& p) {
  if (path != nullptr) {
    path->points[number] = p;
    path->count = number + 1;
  }
}

// A goal that has moved by less than this since the proxy settled is at rest, m. A proxy that would
// then settle no nearer to it by kRestGain_m stays where it is: the difference is rounding.
constexpr double kGoalAtRest_m = 1e-9;
constexpr double kRestGain_m = 1e-11;

// The end of the next straight move.
struct SubGoal {
  Vec3 point = Vec3::Zero();
  // The tool, or where friction makes it seem to be; world frame, m.
  Vec3 tool = Vec3::Zero();
  bool settled = false;     // there is no move: the proxy is where it belongs
  bool lengthened = false;  // by CurvedPath
};

// A sub-goal and the sweep toward it.
struct Move {
  SubGoal goal;
  SweepResult sweep;  // toward the goal, unless that is settled
};

// The continuation after a step.
enum class Next : std::uint8_t {
  go_on,  // with the next step
  again,  // with the first step of this sub-goal
  end,    // the tick ends here
};

// The moves of one tick, and what each sub-goal leaves to the next.
class ProxyTick {
 public:
  ProxyTick(const ProxyMove& move, ProxyState& state, ContactPlanes& planes, ProxyRest& rest)
      : near_(move.near),
        factors_(move.factors),
        h_W_(move.h_W),
        path_(move.path),
        state_(state),
        planes_(planes),
        rest_(rest),
        start_W_(state.p_W),
        has_rest_(state.is_settled && (move.h_W - state.settled_for_W).norm() <= kGoalAtRest_m) {
    state.is_settled = false;
  }

  void run();

 private:
  // The steps of a sub-goal, in their order: gather makes the candidate set valid; collect_planes
  // finds the contact planes; find_move chooses the goal and sweeps; may_move asks the limits;
  // make_move moves the proxy; stays_on_face finds out cheaply that the tick is over.
  Next gather();
  Next collect_planes(double max_push_m);
  Move find_move(double max_push_m);
  SubGoal choose_goal();
  bool ends(const SubGoal& goal);
  void settle();
  void return_to(const Vec3& p_W);
  bool may_move(const Move& move);
  void make_move(const Move& move);
  bool stays_on_face(const Move& move);

  // Says that a limit ends the tick before the proxy has reached the goal.
  void end_short_of(const Vec3& goal_W) {
    rest_.flags |= kTouchIterationsExhausted;
    rest_.short_of_goal_m = (goal_W - state_.p_W).norm();
  }
  void sweep_to_tool();
  void escape_overfull_planes();
  void forget_left_out();

  const NearbySurfaces& near_;
  const FrictionFactors& factors_;
  const Vec3& h_W_;
  ProxyPath* path_;
  ProxyState& state_;
  ContactPlanes& planes_;
  ProxyRest& rest_;
  // The constraints met in this tick; forgotten when the candidates get new numbers.
  ConstraintMemory constraints_;
  CurvedPath curve_;
  Descent descent_;
  // True once the proxy has returned to a place where only its contact is still to be found.
  bool is_over_ = false;
  // The proxy at the start of the tick (world frame, m), and whether it had settled there for the
  // goal of this tick.
  const Vec3 start_W_;
  bool has_rest_ = false;
  // True once the proxy slipped in this tick: it then slips in the rest of it.
  bool slipped_ = false;
};

void ProxyTick::run() {
  // An overlap, which rounding or a deformation leaves, is pushed out by the first sub-goal only:
  // afterwards the proxy's own moves keep it clear.
  double max_push_m = kMaxPushOut_m;
  for (;;) {
    if (!is_over_) {
      add_point(path_, rest_.sub_goals, state_.p_W);
    }
    Next next = gather();
    if (next == Next::go_on) {
      next = collect_planes(max_push_m);
    }
    if (next == Next::again) {
      continue;
    }
    if (next == Next::end) {
      return;
    }
    const Move move = find_move(max_push_m);
    if (ends(move.goal)) {
      return;
    }
    if (is_over_) {
      continue;
    }
    if (!may_move(move)) {
      return;
    }
    make_move(move);
    if (stays_on_face(move)) {
      add_point(path_, rest_.sub_goals, state_.p_W);
      settle();
      return;
    }
    max_push_m = 0.0;
  }
}

// Makes the candidate set valid at the proxy.
Next ProxyTick::gather() {
  const std::size_t before = near_.candidates.gatherings();
  const Gathering gathering = near_.candidates.ensure(near_.scene, near_.margins, state_.p_W);
  // A gathering gives the candidates new numbers, and the memory holds numbers.
  if (rest_.sub_goals == 0 || near_.candidates.gatherings() != before) {
    constraints_.clear();
  }
  if (gathering == Gathering::complete) {
    return Next::go_on;
  }
  if (gathering == Gathering::begun) {
    end_short_of(h_W_);
    // The planes that held the proxy before give the force.
    find_active_constraints(near_.scene, factors_, state_.p_W, h_W_, planes_, rest_);
    return Next::end;
  }
  rest_.flags |= kTouchCandidatesOverflow;
  // Too many triangles come near even in the smallest capsule. Those of an object that the proxy
  // overlaps do not count: it is left out, and the sub-goal begins again.
  if (near_.candidates.left_out().add_overlapped(near_.scene, near_.margins, state_.p_W,
                                                 kMaxPushOut_m)) {
    forget_left_out();
    return Next::again;
  }
  if (rest_.sub_goals < kMaxSubGoals) {
    sweep_to_tool();
    add_point(path_, ++rest_.sub_goals, state_.p_W);
  }
  return Next::end;
}

// Collects the planes at the proxy.
Next ProxyTick::collect_planes(double max_push_m) {
  // The planes of the sub-goal before are about to be replaced. If this one ends early their
  // contact still gives the force.
  if (rest_.plane_count > 0) {
    state_.last_contact = hardest_contact(rest_);
  }
  PlaneCollector collector(near_, state_.p_W, max_push_m);
  switch (collector.collect(constraints_, planes_, rest_.flags)) {
    case PlaneCollector::Result::unfinished:
      end_short_of(h_W_);
      rest_.plane_count = 0;
      return Next::end;
    case PlaneCollector::Result::overlapped:
      forget_left_out();
      return Next::again;
    case PlaneCollector::Result::complete:
      break;
  }
  // The sphere has moved past the end of the face that held it.
  if (rest_.plane_count > 0 && planes_.empty()) {
    collector.add_face_below(planes_, rest_.flags);
  }
  return Next::go_on;
}

// Chooses the next sub-goal and sweeps to it. A goal that would begin a cycle is chosen again with
// the recalled planes, and one whose sweep is blocked at its start with the plane of the candidate
// that blocks it: most edges and vertices give their planes in this manner. The recalled planes are
// those that held the proxy at the place it has left; they bound it from any distance. The loop
// ends after kMaxContactPlanes + 1 sweeps.
Move ProxyTick::find_move(double max_push_m) {
  const Vec3& p = state_.p_W;
  PlaneCollector collector(near_, p, max_push_m);
  Move move;
  std::size_t sweeps = 0;
  bool has_recalled = false;
  for (;;) {
    move.goal = choose_goal();
    const SubGoal& goal = move.goal;
    if (!has_recalled && !goal.settled && !goal.lengthened &&
        (constraints_.would_cycle(p, goal.point, h_W_) || descent_.is_stalling()) &&
        constraints_.recall(planes_)) {
      has_recalled = true;
      collector.add_recalled(constraints_, planes_, rest_.flags);
      continue;
    }
    has_recalled = false;
    if (goal.settled) {
      return move;
    }
    move.sweep = sweep_toward(near_, p, goal.point, rest_, constraints_);
    if (const FirstHit& hit = move.sweep.beyond; hit.object != kNoObject) {
      // The contact of this tick, should it end before the object is measured there.
      state_.last_contact = {.object = hit.object, .triangle = hit.triangle};
    }
    if (++sweeps > kMaxContactPlanes || move.sweep.blocked_by == kNoCandidate ||
        !collector.add_blocking(move.sweep.blocked_by, planes_, rest_.flags)) {
      return move;
    }
  }
}

// Projects the tool on the planes, holds the proxy by friction and lengthens the move on a curved
// path. A move below kSettled_m is none.
SubGoal ProxyTick::choose_goal() {
  const Vec3& p = state_.p_W;
  const ActiveConstraints active =
      find_active_constraints(near_.scene, factors_, p, h_W_, planes_, rest_);
  if (active.projection.active_count == 0) {
    const bool arrived = (h_W_ - p).squaredNorm() <= 0.0;
    if (arrived) {
      state_.friction = FrictionState::free;
    }
    return {.point = h_W_, .tool = h_W_, .settled = arrived};
  }
  const HeldGoal held =
      hold_by_friction(near_.scene, active, rest_, h_W_, planes_, state_, slipped_);
  if (held.sticks) {
    return {.point = held.point, .tool = held.tool, .settled = held.settled};
  }
  const Vec3 move = held.point - p;
  if (move.norm() <= kSettled_m) {
    return {.point = p, .tool = held.tool, .settled = true};
  }
  const Candidate& first = near_.candidates.candidate(rest_.planes[0].candidate);
  const Vec3 lengthened = curve_.lengthen(move, p, held.tool, rest_, planes_, first.triangle);
  return {.point = p + lengthened, .tool = held.tool, .lengthened = lengthened != move};
}

// Returns true if the tick ends where the proxy is. A proxy whose moves bring it no nearer to the
// goal returns to the nearest place, whose contact is then still to be found. Under a goal at rest,
// so does one that would settle no nearer than where it had settled before. The moves compare
// places at their rest height: below it, where a sweep may end, every place is nearer.
bool ProxyTick::ends(const SubGoal& goal) {
  if (is_over_) {
    settle();
    return true;
  }
  const Vec3& p = state_.p_W;
  if (!goal.settled) {
    const Vec3 at_rest_W = planes_.empty() ? p : planes_.resting_position(p);
    if (!descent_.note((goal.tool - at_rest_W).norm(), p)) {
      return_to(descent_.best_W());
    }
    return false;
  }
  if (has_rest_ && p != start_W_ &&
      (goal.tool - p).norm() >= (goal.tool - start_W_).norm() - kRestGain_m) {
    return_to(start_W_);
    return false;
  }
  settle();
  return true;
}

// Remembers that the proxy is where the goal wants it. A goal at rest stays the one for which the
// proxy came there.
void ProxyTick::settle() {
  state_.is_settled = true;
  if (!has_rest_ || state_.p_W != start_W_) {
    state_.settled_for_W = h_W_;
  }
}

// Returns to a place of this tick. The path there is free: it is the path that led away.
void ProxyTick::return_to(const Vec3& p_W) {
  state_.p_W = p_W;
  near_.candidates.move_to(p_W);
  is_over_ = true;
}

// Returns true if the tick goes on with this move. A tick whose budget is spent still makes its
// first move if the proxy has waited, so that no place can hold it for ever.
bool ProxyTick::may_move(const Move& move) {
  const bool is_free = move.sweep.travel_m > 0.0;
  const bool must_move = rest_.sub_goals == 0 && is_free && near_.candidates.has_waited();
  if (rest_.sub_goals == kMaxSubGoals || (near_.candidates.budget().is_exhausted() && !must_move)) {
    end_short_of(move.goal.point);
    return false;
  }
  // The planes leave no free direction. If more planes hold the proxy than are kept, the missing
  // ones may be the reason.
  if (!is_free) {
    escape_overfull_planes();
  }
  return is_free;
}

// Makes the move and leaves what the next sub-goal needs: the constraints that held the proxy here
// (not those of a lengthened move, which leaves them behind), the move along a crease, and the
// position from which candidates are measured.
void ProxyTick::make_move(const Move& move) {
  const auto& [goal, sweep] = move;
  Vec3& p = state_.p_W;
  constraints_.leave(p, rest_, goal.lengthened ? std::size_t{0} : rest_.plane_count);
  if (rest_.plane_count == 2) {
    curve_.remember_crease(goal.lengthened ? Vec3{Vec3::Zero()} : Vec3{goal.point - p});
  }
  p = sweep.arrived ? goal.point : Vec3{p + sweep.travel_m * sweep.direction};
  if (sweep.is_known) {
    near_.candidates.move_to_end(p);
  } else {
    near_.candidates.move_to(p);
  }
  ++rest_.sub_goals;
  near_.candidates.budget().spend(kCostOfSubGoal);
}

// Returns true if the proxy has come to rest on the face that held it before the move, and sets
// its distance. The test is not made after a tick's first move: on small triangles it mostly fails,
// and it would cost more than it saves.
bool ProxyTick::stays_on_face(const Move& move) {
  const bool may_stay = move.sweep.is_known && !move.goal.lengthened && rest_.sub_goals > 1;
  if (!may_stay || !is_still_on_face(near_, state_.p_W, constraints_, rest_)) {
    return false;
  }
  Nearest& nearest = rest_.planes[0].nearest;
  nearest.distance += nearest.normal.dot(state_.p_W - constraints_.left_from());
  return true;
}

// Sweeps straight to the tool. Among too many candidates the proxy cannot slide, but it can
// leave. The sweep needs none of them: it goes through the hierarchies, within kMaxCarryBudget.
void ProxyTick::sweep_to_tool() {
  Vec3& p = state_.p_W;
  const Vec3 move = h_W_ - p;
  const double length = move.norm();
  if (length <= 0.0) {
    state_.friction = FrictionState::free;
    return;
  }
  const Sweep sweep{.from = p, .direction = move / length};
  const FirstHit hit = sweep_beyond_candidates(near_, sweep, length, kMaxCarryBudget);
  if (hit.object != kNoObject) {
    state_.last_contact = {.object = hit.object, .triangle = hit.triangle};
  }
  if (hit.travel_m > 0.0) {
    p = hit.travel_m >= length ? h_W_ : Vec3{p + hit.travel_m * sweep.direction};
    near_.candidates.move_to(p);
  }
}

// Sweeps straight to the tool if more planes hold the sphere than are kept and no move along them
// is free.
void ProxyTick::escape_overfull_planes() {
  if ((rest_.flags & kTouchPlanesOverflow) == 0 || rest_.sub_goals > 0) {
    return;
  }
  sweep_to_tool();
  if (state_.p_W == h_W_) {
    rest_.plane_count = 0;
    rest_.normal_W = Vec3::Zero();
    state_.friction = FrictionState::free;
  }
}

// Removes every trace of the objects that are left out now: their planes, their contact, their
// candidates.
void ProxyTick::forget_left_out() {
  rest_.plane_count = 0;
  planes_.clear();
  LastContact& last = state_.last_contact;
  if (last.object != kNoObject && near_.candidates.left_out().has(last.object)) {
    last = {};
  }
  near_.candidates.clear();
}

}  // namespace

LastContact hardest_contact(const ProxyRest& rest) {
  const std::size_t hardest = rest.hardest();
  if (rest.plane_count == 0 || rest.pressure_m[hardest] <= 0.0) {
    return {};
  }
  const ContactPlane& plane = rest.planes[hardest];
  return {.object = plane.object, .triangle = plane.triangle, .normal_W = rest.normal_W};
}

void run_sub_goals(const ProxyMove& move, ProxyState& state, ContactPlanes& planes,
                   ProxyRest& rest) {
  ProxyTick(move, state, planes, rest).run();
}

}  // namespace tactus::rendering
