// The proxy is the centre of a sphere that must stay clear of every triangle; it wants to be at the
// tool. In each sub-goal of a tick
//
//   1. every triangle that the sphere rests on gives a plane through the proxy, normal to the line
//   from its nearest point. A triangle is
//      convex and lies behind that plane, so no move on the plane's positive side can touch it;
//   2. the sub-goal is the point nearest to the tool that satisfies all planes (at most three of
//   them hold it), drawn back to the friction
//      circle;
//   3. the sphere sweeps straight to the sub-goal and stops where it meets a triangle that gave no
//   plane yet.
//
// A triangle whose face is touched gives its plane at once. One that is touched on an edge or a
// vertex gives it only when it stops a sweep: across a flat or hollow seam the neighbour's edge is
// near too, its plane is tilted against the motion, and yet it is never in the way. A face a little
// below a sphere that a move carried past the end of another gives its plane too: else the sphere
// would first come down to it.
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
#include <cmath>
#include <limits>

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
    if (path != nullptr) {
      path->points[rest.sub_goals] = p_;
      path->count = rest.sub_goals + 1U;
    }
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
    p_ = way.arrived ? goal.point : Vec3{p_ + way.travel * way.direction};
    if (way.is_known) {
      neighbourhood_.move_to_end(p_);
    } else {
      neighbourhood_.move_to(p_);
    }
    ++rest.sub_goals;
    neighbourhood_.add_work(kWorkOfASubGoal);
    most_push = 0.0;
  }
}

void SphereProxy::collect_planes(const Scenery& scenery, double most_push, ProxyRest& rest) {
  contact_count_ = 0;
  hovers_ = false;
  for (const std::uint16_t i : neighbourhood_.within_reach_here()) {
    const Nearest& nearest = neighbourhood_.nearest(i, scenery);
    const Candidate& candidate = neighbourhood_.candidate(i);
    const Shell& shell = shells_.of(candidate.point_tool);
    if (nearest.distance > shell.reach_m || candidate.behind) {
      continue;
    }
    if (nearest.feature == Feature::face || nearest.distance < shell.inner_m || has_stopped(i)) {
      add_plane(i, most_push, rest);
    }
  }
  if (contact_count_ > 0) {
    add_recalled_planes(scenery, most_push, rest);
  }
}

// Where a move along a face went past its end, the next face lies a little lower. Its plane bounds
// the sphere there already, so that it need not come down first to find it.
void SphereProxy::look_for_face_below(const Scenery& scenery, ProxyRest& rest) {
  constexpr double kLowest_m = 10e-6;
  double lowest = kLowest_m;
  std::size_t below = kNothing;
  for (const std::uint16_t i : neighbourhood_.within_reach(p_, kLowest_m)) {
    const Candidate& candidate = neighbourhood_.candidate(i);
    const Triangle* const triangle = neighbourhood_.triangle(i, scenery);
    if (triangle == nullptr) {
      continue;
    }
    const double height = triangle->height(p_);
    const double above =
        (candidate.one_sided ? height : std::abs(height)) - shells_.of(candidate.point_tool).rest_m;
    if (above > 0.0 && above < lowest && triangle->faces(p_)) {
      lowest = above;
      below = i;
    }
  }
  if (below != kNothing) {
    neighbourhood_.nearest(below, scenery);
    hovers_ = add_plane(below, 0.0, rest);
  }
}

// In a flat valley the proxy can go back and forth within the thickness of the shell: on either
// side it does not touch the other, and the nearest point of each plane lies beyond it. When it is
// about to go back to where it came from, or as far from the tool as it was there, the triangles
// that held it there give their planes from then on, wherever it is.
bool SphereProxy::goes_back(const Vec3& goal, const Vec3& h) const {
  constexpr double kMostOfTheWay = 0.25;
  const Vec3& from = last_hold_.from;
  return last_hold_.count > 0 && ((goal - h).squaredNorm() >= (from - h).squaredNorm() ||
                                  (goal - from).norm() <= kMostOfTheWay * (p_ - from).norm());
}

bool SphereProxy::recall_last_hold() {
  const std::size_t before = recalled_count_;
  for (const std::size_t i : std::span(last_hold_.candidates).first(last_hold_.count)) {
    if (recalled_count_ < recalled_.size() && !gives_plane(i)) {
      recalled_[recalled_count_++] = i;
    }
  }
  return recalled_count_ > before;
}

bool SphereProxy::gives_plane(std::size_t i) const {
  const auto contacts = std::span(contacts_).first(contact_count_);
  const auto recalled = std::span(recalled_).first(recalled_count_);
  return std::ranges::find(contacts, i, &ContactPlane::candidate) != contacts.end() ||
         std::ranges::find(recalled, i) != recalled.end();
}

// What lies behind such a plane is convex, so that it bounds the proxy from any distance.
void SphereProxy::add_recalled_planes(const Scenery& scenery, double most_push, ProxyRest& rest) {
  for (const std::size_t i : std::span(recalled_).first(recalled_count_)) {
    neighbourhood_.nearest(i, scenery);
    const Candidate& candidate = neighbourhood_.candidate(i);
    if (!candidate.behind && (candidate.primitive == nullptr || convex(*candidate.primitive))) {
      add_plane(i, most_push, rest);
    }
  }
}

bool SphereProxy::has_stopped(std::size_t i) const {
  const auto end = stoppers_.begin() + static_cast<std::ptrdiff_t>(stopper_count_);
  return std::find(stoppers_.begin(), end, i) != end;
}

bool SphereProxy::add_holding_plane(std::size_t i, double most_push, ProxyRest& rest) {
  const Candidate& candidate = neighbourhood_.candidate(i);
  if (candidate.nearest.distance > shells_.of(candidate.point_tool).reach_m) {
    return false;  // met on the way, not held by it
  }
  return add_plane(i, most_push, rest);
}

bool SphereProxy::add_plane(std::size_t i, double most_push, ProxyRest& rest) {
  const Nearest& nearest = neighbourhood_.candidate(i).nearest;
  const Shell& shell = shells_.of(neighbourhood_.candidate(i).point_tool);
  const double to_rest = shell.rest_m - nearest.distance;
  constexpr double kRounding_m = 1e-9;  // a sweep ends there
  const double push =
      nearest.distance < shell.inner_m - kRounding_m ? std::min(to_rest, most_push) : to_rest;
  const ContactPlane contact{
      .plane = {.normal = nearest.normal, .offset = nearest.normal.dot(p_) + push},
      .nearest = nearest,
      .object = neighbourhood_.candidate(i).object,
      .triangle = neighbourhood_.candidate(i).index,
      .candidate = i};
  // Triangles that share the nearest edge or vertex give the same plane.
  constexpr double kSameNormal = 1e-20;
  for (std::size_t k = 0; k < contact_count_; ++k) {
    if ((contacts_[k].plane.normal - contact.plane.normal).squaredNorm() < kSameNormal &&
        contacts_[k].plane.offset >= contact.plane.offset) {
      return false;
    }
  }
  if (contact_count_ < kMaxContactPlanes) {
    contacts_[contact_count_++] = contact;
    return true;
  }
  rest.flags |= kTouchPlanesOverflow;
  const auto farthest = std::ranges::max_element(
      contacts_, {}, [](const ContactPlane& c) { return c.nearest.distance; });
  if (contact.nearest.distance >= farthest->nearest.distance) {
    return false;
  }
  *farthest = contact;
  return true;
}

// How much of the way the sphere may go. A move that leaves the trusted capsule is cut at its
// border, where the neighbourhood is gathered anew; one that leaves even a fresh one is asked of
// the hierarchy, as far as that is cheap.
SphereProxy::Advance SphereProxy::travel_toward(const Scenery& scenery, const Vec3& goal,
                                                const ProxyRest& rest) {
  const Vec3 way = goal - p_;
  const double length = way.norm();
  const Sweep sweep{.from = p_, .direction = way / length};
  const double room = neighbourhood_.trust_along(p_, sweep.direction);
  Advance advance{.direction = sweep.direction};
  if (length <= room) {
    advance.travel = sweep_candidates(scenery, {.sweep = sweep, .length = length, .end = goal},
                                      rest, advance.stopped_by);
    advance.is_known = advance.travel >= length;
  } else {
    const Vec3 border = p_ + room * sweep.direction;
    advance.travel = sweep_candidates(scenery, {.sweep = sweep, .length = room, .end = border},
                                      rest, advance.stopped_by);
    if (neighbourhood_.is_fresh() && advance.travel >= room &&
        neighbourhood_.size() <= kMostToCast) {
      advance.travel = std::max(room, cast(scenery, sweep, length));
    }
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
  for (const std::uint16_t i : neighbourhood_.within_reach(way.end)) {
    if (free < way.length && !neighbourhood_.may_reach(i, sweep.from + free * sweep.direction)) {
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
