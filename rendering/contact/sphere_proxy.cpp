// The proxy is the centre of a sphere that must stay clear of every triangle; it wants to be at the
// tool. In each sub-goal of a tick
//
//   1. every triangle that the sphere rests on gives a plane through the proxy, normal to the line
//      from its nearest point. A triangle is convex and lies behind that plane, so no move on the
//      plane's positive side can touch it (sphere_proxy_planes.cpp);
//   2. the sub-goal is the point nearest to the tool that satisfies all planes (at most three of
//      them hold it), drawn back to the friction circle (sphere_proxy_goal.cpp);
//   3. the sphere sweeps straight to the sub-goal and stops where it meets a triangle that gave no
//      plane yet.
//
// The tool's projection on planes through the proxy is nearer to the tool than the proxy, and so is
// every point on the way there: each move shortens the distance to the tool, so the proxy cannot
// cycle, and it ends where no plane lets it come nearer, a local minimum of that distance. Two
// moves do not: one up to where a plane holds the sphere, by less than the shell is thick
// (goes_back ends the cycles of these), and one that is lengthened (follow_curvature bounds them).
// Every position on the way is one that a sweep has found clear, so it crosses nothing, whatever is
// cut short by a limit.
#include "rendering/contact/sphere_proxy.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "rendering/contact/object_cast.h"
#include "rendering/contact/primitive_sweep.h"

namespace tactus::rendering {
namespace {

using Gathering = Neighbourhood::Gathering;

// A triangle in contact that stops the sphere within this travel holds it already.
constexpr double kHeld_m = 1e-6;
// Among more candidates than this a cast would look at too many triangles to pay.
constexpr std::size_t kMostToCast = 24;
// In units of kMaxWork. A stop counts more than it takes.
constexpr std::size_t kWorkOfASubGoal = 12;
constexpr std::size_t kWorkOfAStop = 18;
constexpr std::size_t kWorkOfACastTriangle = 6;

Touched touched_by(const ProxyRest& rest) {
  const std::size_t hardest = rest.hardest();
  if (rest.plane_count == 0 || rest.pressure_m[hardest] <= 0.0) {
    return {};
  }
  const ContactPlane& plane = rest.planes[hardest];
  return {.object = plane.object, .triangle = plane.triangle, .normal_W = rest.normal_W};
}

void add_point(ProxyPath* path, std::size_t number, const Vec3& p) {
  if (path != nullptr) {
    path->points[number] = p;
    path->count = number + 1;
  }
}

}  // namespace

void SphereProxy::place(const Vec3& p_W) {
  p_ = p_W;
  friction_ = FrictionState::free;
  model_ = {};
  carried_W_ = Vec3::Zero();
  touched_ = {};
  contact_count_ = 0;
  neighbourhood_.clear();
  neighbourhood_.move_to(p_);
}

std::uint32_t SphereProxy::begin_tick(const Scenery& scenery) {
  neighbourhood_.begin_tick(scenery);
  if (!scenery.anything_moved()) {
    return kTouchClean;
  }
  const Carried carried = carry(scenery, shells_, p_, touched_);
  carried_W_ += carried.p_W - p_;
  if (carried.p_W != p_) {
    p_ = carried.p_W;
    neighbourhood_.move_to(p_);
  }
  return carried.flags;
}

void SphereProxy::begin_friction(const Vec3& tool_step_W, double tick_s) {
  model_.begin_tick(tool_step_W - carried_W_, tick_s);
  carried_W_ = Vec3::Zero();
}

ProxyRest SphereProxy::advance(const Scenery& scenery, const Vec3& h_W, ProxyPath* path) {
  start_ = p_;
  start_friction_ = friction_;
  start_model_ = model_;
  start_touched_ = touched_;
  neighbourhood_.start_work();
  return approach(scenery, h_W, path);
}

ProxyRest SphereProxy::advance_again(const Scenery& scenery, const Vec3& h_W, ProxyPath* path) {
  p_ = start_;
  friction_ = start_friction_;
  model_ = start_model_;
  touched_ = start_touched_;
  neighbourhood_.move_to(p_);
  return approach(scenery, h_W, path);
}

ProxyRest SphereProxy::approach(const Scenery& scenery, const Vec3& h_W, ProxyPath* path) {
  ProxyRest rest = seek(scenery, h_W, path);
  constexpr std::uint32_t kUnfinished = kTouchIterationsExhausted | kTouchCandidatesOverflow;
  if (rest.plane_count == 0 && (rest.flags & kUnfinished) != 0) {
    press_as_before(scenery, h_W, rest);
  }
  touched_ = touched_by(rest);
  return rest;
}

ProxyRest SphereProxy::seek(const Scenery& scenery, const Vec3& h_W, ProxyPath* path) {
  slipped_ = false;
  last_crease_move_ = Vec3::Zero();
  least_left_m_.fill(std::numeric_limits<double>::infinity());
  ProxyRest rest;
  double most_push = kMostPushOut_m;
  for (;;) {
    add_point(path, rest.sub_goals, p_);
    const std::size_t before = neighbourhood_.gatherings();
    const Gathering gathering = neighbourhood_.ensure(scenery, shells_, p_);
    const bool gathered = neighbourhood_.gatherings() != before;
    if (rest.sub_goals == 0 || gathered) {
      stopper_count_ = 0;
      recalled_count_ = 0;
      last_hold_.count = 0;
    }
    if (gathering == Gathering::begun) {
      rest.flags |= kTouchIterationsExhausted;
      press(scenery, h_W, rest);  // on what held it before
      return rest;
    }
    if (gathering != Gathering::complete) {
      rest.flags |= kTouchCandidatesOverflow;
      if (gathering == Gathering::too_many) {
        return rest;
      }
    }
    collect_planes(scenery, most_push, rest);
    if (rest.plane_count > 0) {
      touched_ = touched_by(rest);
      if (contact_count_ == 0) {
        look_for_face_below(scenery, rest);
      }
    }
    Goal goal;
    Advance way;
    do {
      goal = choose_goal(scenery, h_W, rest);
      if (!goal.settled && !goal.stretched && goes_back(goal.point, h_W) && recall_last_hold()) {
        add_recalled_planes(scenery, most_push, rest);
        goal = choose_goal(scenery, h_W, rest);
      }
      if (goal.settled) {
        return rest;
      }
      way = travel_toward(scenery, goal.point, rest);
    } while (way.stopped_by != kNothing && add_holding_plane(way.stopped_by, most_push, rest));
    if (rest.sub_goals == kMaxSubGoals || neighbourhood_.work() > kMaxWork) {
      rest.flags |= kTouchIterationsExhausted;
      return rest;
    }
    if (way.travel <= 0.0) {
      return rest;
    }
    last_hold_.count = goal.stretched ? std::size_t{0} : rest.plane_count;
    last_hold_.from = p_;
    for (std::size_t i = 0; i < last_hold_.count; ++i) {
      last_hold_.candidates[i] = rest.planes[i].candidate;
    }
    if (rest.plane_count == 2) {
      last_crease_move_ = goal.stretched ? Vec3{Vec3::Zero()} : Vec3{goal.point - p_};
    }
    const Vec3 from = p_;
    p_ = way.arrived ? goal.point : Vec3{p_ + way.travel * way.direction};
    if (way.is_known) {
      neighbourhood_.move_to_end(p_);
    } else {
      neighbourhood_.move_to(p_);
    }
    ++rest.sub_goals;
    neighbourhood_.add_work(kWorkOfASubGoal);
    if (way.is_known && !goal.stretched && rest.sub_goals > 1 && is_still_on_face(scenery, rest)) {
      Nearest& nearest = rest.planes[0].nearest;
      nearest.distance += nearest.normal.dot(p_ - from);
      add_point(path, rest.sub_goals, p_);
      return rest;
    }
    most_push = 0.0;
  }
}

// Whether another look at what holds the proxy, which has come to the goal, would find nothing new:
// on the one face that held it the plane is the same, and whatever else is near is touched on its
// border, where it gives none. After a tick's first move that is not asked: where triangles are
// small it mostly is not so, and asking would cost more than it saves.
bool SphereProxy::is_still_on_face(const Scenery& scenery, const ProxyRest& rest) {
  const ContactPlane& contact = rest.planes[0];
  if (rest.plane_count != 1 || contact.nearest.feature != Feature::face || recalled_count_ > 0) {
    return false;
  }
  bool is_held = false;
  for (const std::uint16_t i : neighbourhood_.within_reach_here()) {
    const Triangle* const triangle = neighbourhood_.triangle(i, scenery);
    if (triangle == nullptr || has_stopped(i) || triangle->faces(p_) != (i == contact.candidate)) {
      return false;
    }
    is_held = is_held || i == contact.candidate;
  }
  return is_held;
}

// How much of the way the sphere may go. A move that leaves the trusted capsule is cut at its
// border, where the neighbourhood is gathered anew; one that leaves even a fresh one is asked of
// the hierarchy, as far as that is cheap.
SphereProxy::Advance SphereProxy::travel_toward(const Scenery& scenery, const Vec3& goal,
                                                const ProxyRest& rest) {
  const Vec3 way = goal - p_;
  const double length = way.norm();
  const Sweep sweep{.from = p_, .direction = way / length};
  const bool stays = neighbourhood_.trusts(goal);
  const double room =
      stays ? length : std::min(length, neighbourhood_.trust_along(p_, sweep.direction));
  const Vec3 end = stays ? goal : Vec3{p_ + room * sweep.direction};
  Advance advance{.direction = sweep.direction};
  advance.travel = sweep_candidates(scenery, {.sweep = sweep, .length = room, .end = end}, rest,
                                    advance.stopped_by);
  advance.is_known = stays && advance.travel >= length;
  if (!stays && neighbourhood_.is_fresh() && advance.travel >= room &&
      neighbourhood_.size() <= kMostToCast) {
    advance.travel = std::max(room, cast(scenery, sweep, length));
  }
  advance.arrived = advance.travel >= length;
  if (advance.stopped_by != kNothing && stopper_count_ < stoppers_.size() &&
      !has_stopped(advance.stopped_by)) {
    stoppers_[stopper_count_++] = advance.stopped_by;
  }
  if (advance.travel > kHeld_m) {
    advance.stopped_by = kNothing;
  }
  return advance;
}

// A distance is convex along the way, so what is out of reach at its end, by the tangent at its
// start, is out of reach all along. Of the others most lie behind the planes that hold the sphere:
// on a convex surface, all.
double SphereProxy::sweep_candidates(const Scenery& scenery, const Way& way, const ProxyRest& rest,
                                     std::size_t& stopped_by) {
  const Sweep& sweep = way.sweep;
  SeparatingPlanes planes(sweep.from, way.end);
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    planes.add(rest.planes[i].plane.normal);
  }
  double free = way.length;
  std::optional<Neighbourhood::Bounded> stop;  // once there is one
  for (const std::uint16_t i : neighbourhood_.within_reach(way.end)) {
    if (stop && !neighbourhood_.may_reach(i, *stop)) {
      continue;
    }
    if (neighbourhood_.is_worked_out()) {
      stopped_by = kNothing;
      return 0.0;  // what was measured is kept: the next tick goes on from there
    }
    const Candidate& candidate = neighbourhood_.candidate(i);
    const Shell& shell = shells_.of(candidate.point_tool);
    const Triangle* const triangle = neighbourhood_.triangle(i, scenery);
    if (triangle != nullptr && planes.keep_off(*triangle, shell.inner_m)) {
      continue;
    }
    const Nearest& start = neighbourhood_.nearest(i, scenery);
    const double travel =
        candidate.primitive != nullptr
            ? travel_to_contact(*candidate.primitive, scenery[candidate.object].sides, sweep, free,
                                shell, candidate.seen)
            : travel_to_contact(candidate.triangle, candidate.one_sided, sweep, free, shell, start);
    if (travel < free) {
      free = travel;
      stop.emplace(neighbourhood_, sweep.from + free * sweep.direction);
      stopped_by = i;
      neighbourhood_.add_work(kWorkOfAStop);
    }
  }
  return free;
}

double SphereProxy::cast(const Scenery& scenery, const Sweep& sweep, double length) {
  constexpr std::size_t kMostMeasured = 64;
  std::size_t room = kMostMeasured;
  const double free = cast_on_all(scenery, shells_, sweep, length, room);
  neighbourhood_.add_work(kWorkOfACastTriangle * (kMostMeasured - room));
  return free;
}

}  // namespace tactus::rendering
