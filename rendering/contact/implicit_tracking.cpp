// In each sub-goal of a tick
//
//   1. if the proxy rests on the surface, the tangent plane there holds it; the sub-goal is the
//      point of the plane nearest to the tool, drawn back to the friction circle;
//   2. on smooth ground the proxy glides: a tangent step corrected for curvature, back to the
//      surface along the gradient (rendering/contact/implicit_glide.h);
//   3. elsewhere it goes straight to the sub-goal and stops where intervals see the surface in the
//      way. What stops it at once, as the second wall of a crease does, gives one more plane.
//
// Without contact the sub-goal is the tool itself: this is how first contact is found, and how
// contact breaks when the tool leaves through the plane.
#include "rendering/contact/implicit_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rendering/contact/first_crossing.h"
#include "rendering/contact/implicit_glide.h"
#include "rendering/friction/cone.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Moves shorter than this are none: a micronewton at 1000 N/m.
constexpr double kSettled_m = 1e-9;
// What stops the proxy within this travel holds it already.
constexpr double kHeld_m = 1e-6;
constexpr std::size_t kMostPlanes = 4;

// The part of a straight way within a box.
struct Inside {
  double enter = 0.0;
  double leave = 1.0;
};

Inside clip(const Box& box, const Vec3& from, const Vec3& way) {
  Inside inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = box.lower[axis] - from[axis];
    const double upper = box.upper[axis] - from[axis];
    if (way[axis] == 0.0) {
      inside.leave = lower <= 0.0 && upper >= 0.0 ? inside.leave : -1.0;
      continue;
    }
    const double one = lower / way[axis];
    const double other = upper / way[axis];
    inside.enter = std::max(inside.enter, std::min(one, other));
    inside.leave = std::min(inside.leave, std::max(one, other));
  }
  return inside;
}

class Tick {
 public:
  Tick(ImplicitProxyState& state, const ImplicitSurface& surface, const ConeFriction& friction,
       const Vec3& h_O)
      : state_(state),
        surface_(surface),
        friction_(friction),
        h_(h_O),
        field_(surface, 1.0, kMaxFormulaWork) {}

  ImplicitRest run() {
    while (!step()) {
      ++rest_.sub_goals;
    }
    return rest_;
  }

 private:
  struct Goal {
    Vec3 point = Vec3::Zero();
    bool settled = false;
  };

  // One sub-goal. True when the tick is over.
  bool step() {
    plane_count_ = 0;
    if (rest_.sub_goals == kMaxSubGoals || !field_.can_work()) {
      return exhausted();
    }
    if (!surface_.bounds_O.contains(state_.p_O)) {
      return pass_outside();
    }
    if (state_.side == 0.0) {
      find_side();
    }
    if (state_.side < 0.0 && surface_.sides == Sides::one) {
      return come_out();
    }
    field_.set_side(state_.side);
    if (!is_sampled_) {
      here_ = sample(field_, state_.p_O);
      is_sampled_ = true;
    }
    if (here_.value < 0.0) {  // another formula since the last tick
      move_to(state_.p_O);
      state_.side = 0.0;
      return false;
    }
    if (here_.height <= kImplicitReach_m / surface_.scale_m) {
      add_tangent_plane();
    }
    return go();
  }

  // Over, with the proxy where it is known to be free. The planes of the last sub-goal stay in the
  // result.
  bool exhausted() {
    rest_.flags |= kTouchIterationsExhausted;
    return true;
  }

  void move_to(const Vec3& p) {
    state_.p_O = p;
    is_sampled_ = false;
  }

  void forget_contact() {
    rest_.planes = 0;
    rest_.normal_W = Vec3::Zero();
    state_.friction = FrictionState::free;
  }

  // Beyond the bounds nothing is in the way.
  bool pass_outside() {
    forget_contact();
    state_.side = 0.0;
    const Vec3 way = h_ - state_.p_O;
    const Inside inside = clip(surface_.bounds_O, state_.p_O, way);
    if (inside.enter > inside.leave) {
      move_to(h_);
      return true;
    }
    const Vec3 entry = state_.p_O + inside.enter * way;
    move_to(entry.cwiseMax(surface_.bounds_O.lower).cwiseMin(surface_.bounds_O.upper));
    return false;
  }

  void find_side() {
    field_.set_side(1.0);
    state_.side = field_.value(state_.p_O) < 0.0 ? -1.0 : 1.0;
  }

  // Within a one-sided solid the proxy stays with the tool, up to where that comes out.
  bool come_out() {
    forget_contact();
    field_.set_side(-1.0);
    const Crossing crossing = cross_toward(h_);
    if (crossing.way == Way::blocked) {
      move_to(share_of_way(crossing.blocked_at));
      state_.side = 0.0;
      return false;
    }
    if (crossing.way == Way::unknown) {
      move_to(share_of_way(crossing.free_to));
      return exhausted();
    }
    move_to(h_);
    return true;
  }

  void add_tangent_plane() {
    if (here_.steepness > 0.0) {
      state_.normal_O = here_.normal;
    } else if (state_.normal_O.isZero()) {
      state_.normal_O = (state_.p_O - h_).normalized();
    }
    const double rise = kImplicitRest_m / surface_.scale_m - here_.height;
    planes_[plane_count_++] = {.normal = state_.normal_O,
                               .offset = state_.normal_O.dot(state_.p_O) + rise};
  }

  // The plane of what blocks the way at p_O; false if it is none that is new.
  bool add_blocking_plane(const Vec3& p_O) {
    constexpr double kSameNormal = 1e-20;
    const ImplicitSample wall = sample(field_, p_O);
    const Plane plane{.normal = wall.normal,
                      .offset = wall.normal.dot(p_O) + kImplicitRest_m / surface_.scale_m};
    const auto held = [&](const Plane& p) {
      return (p.normal - plane.normal).squaredNorm() < kSameNormal && p.offset >= plane.offset;
    };
    if (!(wall.steepness > 0.0) ||
        std::any_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(plane_count_),
                    held)) {
      return false;
    }
    if (plane_count_ == planes_.size()) {
      rest_.flags |= kTouchPlanesOverflow;
      return false;
    }
    planes_[plane_count_++] = plane;
    return true;
  }

  // To the sub-goal, or as far as the way is free. True when the tick is over.
  bool go() {
    for (;;) {
      const Goal goal = choose_goal();
      if (goal.settled) {
        return true;
      }
      if (rest_.planes == 1 && plane_count_ == 1 && glide_toward(goal.point)) {
        return false;
      }
      const Crossing crossing = cross_toward(goal.point);
      if (crossing.way == Way::free) {
        move_to(goal.point);
        return false;
      }
      const double length_m = (target_ - state_.p_O).norm() * surface_.scale_m;
      if (crossing.way == Way::blocked && crossing.free_to * length_m <= kHeld_m &&
          add_blocking_plane(share_of_way(crossing.blocked_at))) {
        continue;
      }
      const bool stuck = crossing.free_to <= 0.0;
      move_to(share_of_way(crossing.free_to));
      return crossing.way == Way::unknown ? exhausted() : stuck;
    }
  }

  bool glide_toward(const Vec3& goal) {
    const auto to = glide(field_, {.from = here_, .goal = goal, .tool = h_});
    if (to) {
      move_to(to->point);
      here_ = *to;
      is_sampled_ = true;
    }
    return to.has_value();
  }

  // The first crossing between the proxy and a point, or the wall of the bounds on the way there.
  Crossing cross_toward(const Vec3& to) {
    const Vec3 way = to - state_.p_O;
    const double leave = clip(surface_.bounds_O, state_.p_O, way).leave;
    target_ = leave < 1.0 ? Vec3{state_.p_O + std::max(leave, 0.0) * way} : to;
    if (leave <= 0.0) {
      return {};  // it stands on the wall, and leaves
    }
    constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
    return first_crossing(field_, state_.p_O, target_, kAnyNumber);
  }

  // Of the way that cross_toward looked at.
  [[nodiscard]] Vec3 share_of_way(double share) const {
    return share == 1.0 ? target_ : Vec3{state_.p_O + share * (target_ - state_.p_O)};
  }

  Goal choose_goal() {
    const std::span<const Plane> planes{planes_.data(), plane_count_};
    const PlaneProjection projection = project_on_planes(h_, planes);
    rest_.planes = projection.active_count;
    rest_.normal_W = Vec3::Zero();
    if (projection.active_count == 0) {
      state_.friction = FrictionState::free;
      return {.point = h_, .settled = h_ == state_.p_O};
    }
    double push_m = 0.0;
    for (std::size_t i = 0; i < projection.active_count; ++i) {
      const double pressure_m = projection.pressure_m[i] * surface_.scale_m;
      rest_.normal_W += pressure_m * (surface_.R_WO * planes[projection.active[i]].normal);
      push_m += pressure_m;
    }
    rest_.normal_W.normalize();
    const FrictionStep step =
        apply_cone(surface_.scale_m * (state_.p_O - projection.point), Vec3::Zero(),
                   {.static_radius_m = friction_.static_coefficient * push_m,
                    .dynamic_radius_m = friction_.dynamic_coefficient * push_m},
                   state_.friction);
    slipped_ = slipped_ || step.state == FrictionState::slip;
    state_.friction = slipped_ ? FrictionState::slip : step.state;
    const Vec3 goal = projection.point + step.goal / surface_.scale_m;
    const bool settled = step.state == FrictionState::stick || !projection.feasible ||
                         (goal - state_.p_O).norm() * surface_.scale_m <= kSettled_m;
    return {.point = goal, .settled = settled};
  }

  ImplicitProxyState& state_;
  const ImplicitSurface& surface_;
  const ConeFriction& friction_;
  const Vec3 h_;
  ImplicitField field_;
  ImplicitRest rest_;
  ImplicitSample here_;  // at the proxy, if is_sampled_
  bool is_sampled_ = false;
  bool slipped_ = false;  // in this tick
  std::array<Plane, kMostPlanes> planes_;
  std::size_t plane_count_ = 0;
  Vec3 target_ = Vec3::Zero();
};

}  // namespace

void ImplicitTracker::place(const Vec3& p_W) {
  p_W_ = p_W;
  placed_ = false;
  state_ = {};
}

ImplicitRest ImplicitTracker::advance(const ImplicitSurface& surface, const ConeFriction& friction,
                                      const Vec3& h_W) {
  ImplicitRest rest;
  if (!(h_W.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m)) {
    rest.proxy_W = p_W_;
    rest.flags = kTouchToolInvalid;
    return rest;
  }
  if (!placed_) {
    state_.p_O = surface.to_object(p_W_);
    placed_ = true;
  }
  rest = Tick(state_, surface, friction, surface.to_object(h_W)).run();
  p_W_ = surface.to_world(state_.p_O);
  rest.proxy_W = p_W_;
  rest.friction = state_.friction;
  rest.depth_m = rest.planes > 0 ? (p_W_ - h_W).dot(rest.normal_W) : 0.0;
  return rest;
}

}  // namespace tactus::rendering
