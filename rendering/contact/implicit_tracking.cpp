// Repeats these steps in each sub-goal of a tick:
//
//   1. if the proxy rests on the surface, the tangent plane there is the active constraint; the
//      sub-goal is the plane's point nearest to the tool, drawn back to the friction circle;
//   2. on smooth ground the proxy glides: a tangent step corrected for curvature, back to the
//      surface along the gradient (rendering/contact/implicit_glide.h);
//   3. elsewhere it sweeps straight to the sub-goal and stops where intervals find the surface. A
//      surface that blocks it at once, such as the second wall of a crease, gives one more plane.
//
// Without contact the sub-goal is the tool itself. First contact is found in this manner, and
// contact ends when the tool leaves through the plane.
#include "rendering/contact/implicit_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "rendering/contact/implicit_glide.h"
#include "rendering/contact/implicit_segment.h"
#include "rendering/friction/cone.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/limits.h"
#include "rendering/material/sliding_surface.h"

namespace tactus::rendering {
namespace {

// A shorter move counts as none: its force is a micronewton at 1000 N/m.
constexpr double kSettled_m = 1e-9;
// A surface that stops the proxy within this travel counts as an active constraint.
constexpr double kHeld_m = 1e-6;
// A move along the surface that gains less than this is none.
constexpr double kLeastGain_m = 1e-10;
constexpr std::size_t kMostPlanes = 4;
// Planes that may be met without a move.
constexpr std::size_t kMostAttempts = 8;

class Tick {
 public:
  Tick(ImplicitProxyState& state, const ImplicitSurface& surface, const Material& material,
       Vec3 h_O)
      : state_(state),
        surface_(surface),
        material_(material),
        h_(std::move(h_O)),
        field_(surface, 1.0, kMaxFormulaBudget) {}

  ImplicitRest run() {
    while (!step()) {
      ++rest_.sub_goals;
    }
    if (stalled_ > 0 && rest_.planes > 0 && std::isfinite(nearest_m_)) {
      state_.p_O = best_;
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
    if (rest_.sub_goals == kMaxSubGoals || !field_.can_evaluate()) {
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
    const double height_m = here_.height * surface_.scale_m;
    if (height_m < 0.5 * kImplicitRest_m && !has_risen_) {
      has_risen_ = true;
      move_to(raised_to_rest(field_, state_.p_O).value_or(state_.p_O));
      return false;
    }
    if (is_stalled(height_m)) {
      return true;
    }
    if (height_m <= kImplicitReach_m) {
      add_tangent_plane();
    }
    return go();
  }

  // Returns true if the proxy only swings between walls, in a pit or in a crease of singular
  // points. The tick ends after a few sub-goals without progress, at the place nearest to the tool
  // where the proxy was at its rest height.
  bool is_stalled(double height_m) {
    constexpr int kPatience = 4;
    constexpr double kGain_m = 1e-9;
    if (height_m > kImplicitReach_m) {
      nearest_m_ = std::numeric_limits<double>::infinity();
      stalled_ = 0;
      return false;
    }
    const double distance_m = (state_.p_O - (h_ - lag_O_)).norm() * surface_.scale_m;
    stalled_ = distance_m < nearest_m_ - kGain_m ? 0 : stalled_ + 1;
    if (distance_m < nearest_m_ && height_m >= 0.5 * kImplicitRest_m) {
      nearest_m_ = distance_m;
      best_ = state_.p_O;
    }
    return stalled_ >= kPatience;
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

  // Nothing blocks the proxy outside the bounds.
  bool pass_outside() {
    forget_contact();
    state_.side = 0.0;
    const Vec3 segment = h_ - state_.p_O;
    const Inside inside = clip(surface_.bounds_O, state_.p_O, segment);
    if (inside.enter > inside.leave) {
      move_to(h_);
      return true;
    }
    const Vec3 entry = state_.p_O + inside.enter * segment;
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
    const SweptSegment segment = sweep_segment(field_, state_.p_O, h_);
    if (segment.crossing.state == SegmentState::blocked) {
      move_to(segment.at(segment.crossing.blocked_at));
      state_.side = 0.0;
      return false;
    }
    if (segment.crossing.state == SegmentState::unknown) {
      move_to(segment.at(segment.crossing.free_to));
      return exhausted();
    }
    move_to(h_);
    return true;
  }

  void add_tangent_plane() {
    const double rise = kImplicitRest_m / surface_.scale_m - here_.height;
    planes_[plane_count_++] = {.normal = here_.normal,
                               .offset = here_.normal.dot(state_.p_O) + rise};
  }

  // Adds the plane of the surface that blocks the segment at p_O. Returns false if it is not new.
  bool add_blocking_plane(const Vec3& p_O) {
    constexpr double kSameNormal = 1e-20;
    const ImplicitSample wall = sample(field_, p_O);
    const Vec3 normal = wall.steepness > 0.0 ? wall.normal : (state_.p_O - h_).stableNormalized();
    const Plane plane{.normal = normal,
                      .offset = normal.dot(p_O) + kImplicitRest_m / surface_.scale_m};
    const auto held = [&](const Plane& p) {
      return (p.normal - plane.normal).squaredNorm() < kSameNormal && p.offset >= plane.offset;
    };
    if (std::any_of(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(plane_count_),
                    held)) {
      return false;
    }
    if (plane_count_ < planes_.size()) {
      planes_[plane_count_++] = plane;
      return true;
    }
    // At most three planes hold the proxy: another makes room.
    const auto holding_end = holding_.begin() + rest_.planes;
    std::size_t idle = 0;
    while (std::find(holding_.begin(), holding_end, idle) != holding_end) {
      ++idle;
    }
    planes_[idle] = plane;
    return true;
  }

  // Moves to the sub-goal, or as far as the segment is free. Returns true when the tick is over.
  bool go() {
    for (std::size_t attempt = 0; attempt < kMostAttempts; ++attempt) {
      const Goal goal = choose_goal();
      if (goal.settled) {
        return true;
      }
      if (rest_.planes == 1 && plane_count_ == 1 && glide_toward(goal.point)) {
        return false;
      }
      const SweptSegment segment = sweep_segment(field_, state_.p_O, goal.point);
      const Crossing& crossing = segment.crossing;
      if (crossing.state == SegmentState::free) {
        move_to(goal.point);
        return false;
      }
      const Vec3 stop = segment.at(crossing.free_to);
      const bool is_held = crossing.state == SegmentState::blocked &&
                           (stop - state_.p_O).norm() * surface_.scale_m <= kHeld_m;
      if (!is_held || !add_blocking_plane(segment.at(crossing.blocked_at))) {
        const bool has_moved = come_to_rest_at(stop);
        return !has_moved && (crossing.state == SegmentState::blocked || exhausted());
      }
    }
    return exhausted();
  }

  // Moves from the end of a segment to the rest height, away from the planes, or back. Returns
  // false, and stays, if the result is no nearer to the tool than before.
  bool come_to_rest_at(const Vec3& stop) {
    Vec3 end = raised_to_rest(field_, stop).value_or(stop);
    if (end == stop) {
      const Vec3 up = rest_.planes > 0 ? Vec3{surface_.R_WO.transpose() * rest_.normal_W}
                                       : (state_.p_O - stop).stableNormalized();
      end = raised_from_crease(field_, state_.p_O, stop, up);
    }
    const double gain_m = ((state_.p_O - h_).norm() - (end - h_).norm()) * surface_.scale_m;
    if (gain_m <= kLeastGain_m) {
      return false;
    }
    move_to(end);
    return true;
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
      holding_[i] = projection.active[i];
      rest_.normal_W += pressure_m * (surface_.R_WO * planes[projection.active[i]].normal);
      push_m += pressure_m;
    }
    rest_.normal_W.normalize();
    return is_plain_cone(material_) ? stay_in_cone(projection, push_m)
                                    : lag_behind(projection, push_m);
  }

  Goal stay_in_cone(const PlaneProjection& projection, double push_m) {
    const FrictionStep step =
        apply_cone(surface_.scale_m * (state_.p_O - projection.point), Vec3::Zero(),
                   {.static_radius_m = material_.friction.static_level * push_m,
                    .dynamic_radius_m = material_.friction.coulomb * push_m},
                   state_.friction);
    slipped_ = slipped_ || step.state == FrictionState::slip;
    state_.friction = slipped_ ? FrictionState::slip : step.state;
    const Vec3 goal = projection.point + step.goal / surface_.scale_m;
    const bool settled = step.state == FrictionState::stick || !projection.feasible ||
                         (goal - state_.p_O).norm() * surface_.scale_m <= kSettled_m;
    return {.point = goal, .settled = settled};
  }

  Goal lag_behind(const PlaneProjection& projection, double push_m) {
    const FrictionLag lag = state_.model.lag(sliding_surface(material_), rest_.normal_W,
                                             material_.stiffness_N_per_m * push_m);
    state_.friction = lag.state;
    lag_O_ = surface_.R_WO.transpose() * (lag.lag_m / surface_.scale_m);
    const Vec3 goal = projection.point - lag_O_;
    const bool settled =
        !projection.feasible || (goal - state_.p_O).norm() * surface_.scale_m <= kSettled_m;
    return {.point = goal, .settled = settled};
  }

  ImplicitProxyState& state_;
  const ImplicitSurface& surface_;
  const Material& material_;
  const Vec3 h_;
  ImplicitField field_;
  ImplicitRest rest_;
  ImplicitSample here_;  // at the proxy, if is_sampled_
  bool is_sampled_ = false;
  double nearest_m_ = std::numeric_limits<double>::infinity();  // from the lagging tool, in contact
  Vec3 best_ = Vec3::Zero();                                    // where that was
  int stalled_ = 0;                                             // sub-goals since it fell
  bool slipped_ = false;                                        // in this tick
  bool has_risen_ = false;  // once a tick, from where the sign of F is in doubt
  std::array<Plane, kMostPlanes> planes_;
  std::size_t plane_count_ = 0;
  std::array<std::size_t, 3> holding_{};  // of planes_, the first rest_.planes
  Vec3 lag_O_ = Vec3::Zero();             // of the tool's nearest point, by a friction model
};

}  // namespace

void ImplicitTracker::place(const Vec3& p_W) {
  p_W_ = p_W;
  placed_ = false;
  state_ = {};
}

ImplicitRest ImplicitTracker::advance(const ImplicitSurface& surface, const Material& material,
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
  rest = Tick(state_, surface, material, surface.to_object(h_W)).run();
  p_W_ = surface.to_world(state_.p_O);
  rest.proxy_W = p_W_;
  rest.friction = state_.friction;
  rest.depth_m = rest.planes > 0 ? (p_W_ - h_W).dot(rest.normal_W) : 0.0;
  return rest;
}

}  // namespace tactus::rendering
