// The proxy is the centre of a sphere that must stay clear of every triangle, as near to the tool
// as possible. One tick is a sequence of sub-goals. In each of them
//
//   1. every triangle in contact gives a plane through the proxy, normal to the line from its
//      nearest point. A triangle is convex and lies behind that plane, so no move on the plane's
//      positive side can touch it (sphere_proxy_planes.cpp);
//   2. the sub-goal is the point nearest to the tool in front of all planes (at most three of them
//      are active), drawn back to the friction circle (sphere_proxy_goal.cpp);
//   3. the sphere sweeps straight to the sub-goal and stops at the first triangle that gave no
//   plane
//      yet (sphere_proxy_sweep.cpp).
//
// The tool's projection on planes through the proxy is nearer to the tool than the proxy, and so is
// every point on the segment to it. Each move shortens the distance to the tool, so the proxy
// cannot cycle, and it ends at a local minimum of that distance. Two moves are exceptions: one that
// lifts the sphere to the rest height of a plane, by less than the contact margin (would_cycle ends
// the cycles of these), and one that is lengthened (follow_curvature bounds them). A sweep has
// proved every position on the path clear, so the proxy crosses nothing, also when a limit ends the
// tick.
#include "rendering/contact/sphere_proxy.h"

#include <limits>

namespace tactus::rendering {
namespace {

using Gathering = CandidateSet::Gathering;

LastContact hardest_contact(const ProxyRest& rest) {
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
  last_contact_ = {};
  contact_count_ = 0;
  just_placed_ = true;
  candidate_set_.start_over();
  candidate_set_.move_to(p_);
}

std::uint32_t SphereProxy::begin_tick(const SceneObjects& scene) {
  candidate_set_.begin_tick(scene);
  if (!scene.anything_moved()) {
    return kTouchClean;
  }
  const Carried carried =
      carry_along(scene, margins_, p_, last_contact_, candidate_set_.left_out());
  carried_W_ += carried.p_W - p_;
  if (carried.p_W != p_) {
    p_ = carried.p_W;
    candidate_set_.move_to(p_);
  }
  return carried.flags;
}

void SphereProxy::begin_friction(const Vec3& tool_step_W, double tick_s) {
  model_.begin_tick(tool_step_W - carried_W_, tick_s);
  carried_W_ = Vec3::Zero();
}

ProxyRest SphereProxy::advance(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  start_ = p_;
  start_friction_ = friction_;
  start_model_ = model_;
  start_last_contact_ = last_contact_;
  candidate_set_.start_tick_budget();
  update_left_out(scene);
  return approach(scene, h_W, path);
}

ProxyRest SphereProxy::advance_again(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  p_ = start_;
  friction_ = start_friction_;
  model_ = start_model_;
  last_contact_ = start_last_contact_;
  candidate_set_.move_to(p_);
  candidate_set_.budget().allow_repeat();
  return approach(scene, h_W, path);
}

// Leaves out the objects that overlap the sphere when it is placed, and takes back objects once the
// sphere is clear of them.
void SphereProxy::update_left_out(const SceneObjects& scene) {
  constexpr double kNoOverlap_m = 0.5e-6;  // within the contact margin
  LeftOut& left_out = candidate_set_.left_out();
  bool changed = false;
  if (just_placed_) {
    changed = left_out.add_overlapped(scene, margins_, p_, kNoOverlap_m);
    just_placed_ = false;
  } else if (left_out.any()) {
    changed = left_out.take_back(scene, margins_, p_);
  }
  if (changed) {
    candidate_set_.clear();
  }
}

void SphereProxy::forget_left_out(ProxyRest& rest) {
  rest.plane_count = 0;
  contact_count_ = 0;
  if (last_contact_.object != kNoObject && candidate_set_.left_out().has(last_contact_.object)) {
    last_contact_ = {};
  }
  candidate_set_.clear();
}

void SphereProxy::escape_overfull_planes(const SceneObjects& scene, const Vec3& h_W,
                                         ProxyRest& rest) {
  if ((rest.flags & kTouchPlanesOverflow) == 0 || rest.sub_goals > 0) {
    return;
  }
  sweep_to_tool(scene, h_W);
  if (p_ == h_W) {
    rest.plane_count = 0;
    rest.normal_W = Vec3::Zero();
    friction_ = FrictionState::free;
  }
}

ProxyRest SphereProxy::approach(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  ProxyRest rest = run_sub_goals(scene, h_W, path);
  constexpr std::uint32_t kUnfinished = kTouchIterationsExhausted | kTouchCandidatesOverflow;
  if (rest.plane_count == 0 && (rest.flags & kUnfinished) != 0) {
    keep_last_contact(scene, h_W, rest);
  }
  last_contact_ = hardest_contact(rest);
  rest.flags |= candidate_set_.left_out().any() ? kTouchOverlap : kTouchClean;
  return rest;
}

// Leaves out the objects that the proxy overlaps by more than kMostPushOut_m. Returns true if there
// are any.
bool SphereProxy::leave_out_overlapped(const SceneObjects& scene, ProxyRest& rest) {
  if (!candidate_set_.left_out().add_overlapped(scene, margins_, p_, kMostPushOut_m)) {
    return false;
  }
  forget_left_out(rest);
  return true;
}

void SphereProxy::sweep_to_tool_if_allowed(const SceneObjects& scene, const Vec3& h_W,
                                           ProxyRest& rest, ProxyPath* path) {
  if (rest.sub_goals < kMaxSubGoals) {
    sweep_to_tool(scene, h_W);
    add_point(path, ++rest.sub_goals, p_);
  }
}

ProxyRest SphereProxy::run_sub_goals(const SceneObjects& scene, const Vec3& h_W, ProxyPath* path) {
  slipped_ = false;
  last_crease_move_ = Vec3::Zero();
  least_left_m_.fill(std::numeric_limits<double>::infinity());
  ProxyRest rest;
  double most_push = kMostPushOut_m;
  for (;;) {
    add_point(path, rest.sub_goals, p_);
    const std::size_t before = candidate_set_.gatherings();
    const Gathering gathering = candidate_set_.ensure(scene, margins_, p_);
    const bool gathered = candidate_set_.gatherings() != before;
    if (rest.sub_goals == 0 || gathered) {
      blocking_count_ = 0;
      recalled_count_ = 0;
      last_constraints_.count = 0;
    }
    if (gathering == Gathering::begun) {
      rest.flags |= kTouchIterationsExhausted;
      active_constraints(scene, h_W, rest);  // on what held it before
      return rest;
    }
    if (gathering != Gathering::complete) {
      rest.flags |= kTouchCandidatesOverflow;
      if (gathering == Gathering::too_many) {
        if (leave_out_overlapped(scene, rest)) {
          continue;
        }
        sweep_to_tool_if_allowed(scene, h_W, rest, path);
        return rest;
      }
    }
    if (rest.plane_count > 0) {
      last_contact_ = hardest_contact(rest);
    }
    if (!collect_planes(scene, most_push, rest)) {
      rest.flags |= kTouchIterationsExhausted;
      rest.plane_count = 0;
      return rest;
    }
    if (found_overlap_) {
      forget_left_out(rest);
      continue;
    }
    if (rest.plane_count > 0 && contact_count_ == 0) {
      add_face_below(scene, rest);
    }
    const auto [goal, sweep] = find_move(scene, h_W, most_push, rest);
    if (goal.settled) {
      return rest;
    }
    const bool must_move = rest.sub_goals == 0 && sweep.travel > 0.0 && candidate_set_.has_waited();
    if (rest.sub_goals == kMaxSubGoals || (candidate_set_.budget().is_exhausted() && !must_move)) {
      rest.flags |= kTouchIterationsExhausted;
      return rest;
    }
    if (sweep.travel <= 0.0) {
      escape_overfull_planes(scene, h_W, rest);
      return rest;
    }
    last_constraints_.take(rest, goal.stretched ? std::size_t{0} : rest.plane_count, p_);
    if (rest.plane_count == 2) {
      last_crease_move_ = goal.stretched ? Vec3{Vec3::Zero()} : Vec3{goal.point - p_};
    }
    const Vec3 from = p_;
    p_ = sweep.arrived ? goal.point : Vec3{p_ + sweep.travel * sweep.direction};
    if (sweep.is_known) {
      candidate_set_.move_to_end(p_);
    } else {
      candidate_set_.move_to(p_);
    }
    ++rest.sub_goals;
    candidate_set_.budget().spend(kCostOfSubGoal);
    if (sweep.is_known && !goal.stretched && rest.sub_goals > 1 && is_still_on_face(scene, rest)) {
      Nearest& nearest = rest.planes[0].nearest;
      nearest.distance += nearest.normal.dot(p_ - from);
      add_point(path, rest.sub_goals, p_);
      return rest;
    }
    most_push = 0.0;
  }
}

// Chooses the sub-goal and sweeps to it. A blocking contact adds its plane, and the choice is
// repeated.
SphereProxy::Move SphereProxy::find_move(const SceneObjects& scene, const Vec3& h_W,
                                         double most_push, ProxyRest& rest) {
  Move move;
  std::size_t sweeps = 0;
  do {
    move.goal = choose_goal(scene, h_W, rest);
    const Goal& goal = move.goal;
    if (!goal.settled && !goal.stretched && would_cycle(goal.point, h_W) &&
        recall_last_constraints()) {
      add_recalled_planes(scene, most_push, rest);
      move.goal = choose_goal(scene, h_W, rest);
    }
    if (goal.settled) {
      break;
    }
    move.sweep = sweep_toward(scene, goal.point, rest);
  } while (++sweeps <= kMaxContactPlanes && move.sweep.blocked_by != kNoCandidate &&
           add_blocking_plane(move.sweep.blocked_by, most_push, rest));
  return move;
}

// Returns true if collecting the planes again at the goal would find nothing new. This holds on a
// single face: its plane is the same, and other near triangles are touched at their borders, where
// they give no plane. The test is not made after a tick's first move: on small triangles it mostly
// fails, and it would cost more than it saves.
bool SphereProxy::is_still_on_face(const SceneObjects& scene, const ProxyRest& rest) {
  const ContactPlane& contact = rest.planes[0];
  if (rest.plane_count != 1 || contact.nearest.feature != Feature::face || recalled_count_ > 0) {
    return false;
  }
  bool is_held = false;
  for (const std::uint16_t i : candidate_set_.within_reach_here()) {
    const Triangle* const triangle = candidate_set_.triangle(i, scene);
    if (triangle == nullptr || is_blocking(i) || triangle->faces(p_) != (i == contact.candidate)) {
      return false;
    }
    is_held = is_held || i == contact.candidate;
  }
  return is_held;
}

}  // namespace tactus::rendering
