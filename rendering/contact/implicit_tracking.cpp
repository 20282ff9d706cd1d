// One tick of a point proxy p on the implicit surface F = 0, toward the tool h. Everything is in
// the object's frame O, in the formula's own unit of length; a length times `scale_m` is in metres
// of the world. F = side * f is above 0 on the side of the proxy.
//
// Each sub-goal of a tick takes these steps:
//
//   1. If the proxy rests on the surface, the tangent plane there is the active constraint. With
//      n = grad F / |grad F| it is n . x >= n . p + rise, where `rise` brings p to the rest height.
//      The sub-goal is the plane's point nearest to the tool, drawn back to the friction circle.
//   2. On smooth ground the proxy glides: a tangent step corrected for curvature, then back to the
//      surface along the gradient (rendering/contact/implicit_glide.h).
//   3. Elsewhere it sweeps straight to the sub-goal and stops where intervals find the surface. A
//      surface that blocks it at once, such as the second wall of a crease, gives one more plane.
//
// Without contact the sub-goal is the tool itself. First contact is found in this manner, and
// contact ends when the tool leaves through the plane: then no plane is active in the projection.
//
// Two things go beyond the paper (see the header) and make the tracking safe. Every move is along
// segments that interval arithmetic has proved free, so the proxy crosses nothing thin. Every move
// along the surface brings it nearer to the tool, so it cannot oscillate; is_stalled() ends the
// ticks in which the gain is only rounding.
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
constexpr double kLeastMove_m = 1e-9;
// A surface that stops the proxy within this travel counts as an active constraint: it gives a
// plane at the proxy, and the sub-goal is chosen again. After a longer travel the move is made
// first.
constexpr double kHeld_m = 1e-6;
// A move along the surface that brings the proxy nearer to the tool by less than this is none.
constexpr double kLeastGain_m = 1e-10;
// The planes that are kept at one position: three can hold a point, and one more is on trial.
constexpr std::size_t kMostPlanes = 4;
// The planes that may be met without a move, before the sub-goal is given up.
constexpr std::size_t kMostAttempts = 8;

// One tick: the proxy's state, the tool and what the sub-goals pass on to each other.
class Tick {
 public:
  Tick(ImplicitProxyState& state, const ImplicitSurface& surface, const Material& material,
       Vec3 h_O, std::size_t budget)
      : state_(state),
        surface_(surface),
        material_(material),
        h_(std::move(h_O)),
        field_(surface, 1.0, budget) {}

  // Repeats sub-goals until the tick is over. After a stall the proxy stays where it was nearest to
  // the tool, and not where the last swing left it.
  ImplicitRest run() {
    const std::size_t budget = field_.left();
    while (!step()) {
      ++rest_.sub_goals;
    }
    if (stalled_ > 0 && rest_.planes > 0 && std::isfinite(nearest_m_)) {
      state_.p_O = best_;
    }
    rest_.evaluated = budget - field_.left();
    return rest_;
  }

 private:
  // The end of the next move.
  struct Goal {
    Vec3 point = Vec3::Zero();
    // True if there is no move: the proxy is where the tool and friction want it.
    bool settled = false;
  };

  // Runs one sub-goal. Returns true when the tick is over.
  //
  // The order matters: F is defined within the bounds only, its sign gives the side, and only a
  // proxy on a known side at its rest height has a tangent plane.
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
    // The formula has changed since the last tick, so the side is found anew.
    if (here_.value < 0.0) {
      move_to(state_.p_O);
      state_.side = 0.0;
      return false;
    }
    // Nearer to the surface than half the rest height, the sign of F is in doubt: the proxy rises
    // first, once a tick.
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
  // points. It counts the sub-goals in contact since the distance to the tool, from which friction
  // makes it lag, last fell by a nanometre. After four of them the tick ends, at the place nearest
  // to the tool where the proxy was at its rest height.
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

  // Ends the tick with the proxy where it is known to be free, and returns true. The planes of the
  // last sub-goal stay in the result, so that it still gives the force.
  bool exhausted() {
    rest_.flags |= kTouchIterationsExhausted;
    return true;
  }

  // Moves the proxy; the sample of F at the old place is not valid there.
  void move_to(const Vec3& p) {
    state_.p_O = p;
    is_sampled_ = false;
  }

  // Ends the contact: no planes, no normal, no friction.
  void forget_contact() {
    rest_.planes = 0;
    rest_.normal_W = Vec3::Zero();
    state_.friction = FrictionState::free;
  }

  // Moves a proxy outside the bounds, where nothing blocks it: to the tool, or to where the segment
  // to the tool enters the bounds. Returns true when the tick is over.
  bool pass_outside() {
    forget_contact();
    state_.side = 0.0;
    const Vec3 segment = h_ - state_.p_O;
    const Inside inside = clip(surface_.bounds_O, state_.p_O, segment);
    if (inside.enter > inside.leave) {
      move_to(h_);
      return true;
    }
    // Rounding must not leave the entry outside, or the next sub-goal would begin there again.
    const Vec3 entry = state_.p_O + inside.enter * segment;
    move_to(entry.cwiseMax(surface_.bounds_O.lower).cwiseMin(surface_.bounds_O.upper));
    return false;
  }

  // Takes the side from the sign of f at the proxy. NaN counts as above 0 (ImplicitField::value).
  void find_side() {
    field_.set_side(1.0);
    state_.side = field_.value(state_.p_O) < 0.0 ? -1.0 : 1.0;
  }

  // Moves a proxy within a one-sided solid: it stays with the tool, up to where that comes out.
  // Seen from inside, the surface blocks a segment where f becomes positive; just beyond it the
  // side is found anew. Returns true when the tick is over.
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

  // Adds the tangent plane at the proxy. `rise` is the way from the proxy's height, which is of
  // first order, to the rest height.
  void add_tangent_plane() {
    const double rise = kImplicitRest_m / surface_.scale_m - here_.height;
    planes_[plane_count_++] = {.normal = here_.normal,
                               .offset = here_.normal.dot(state_.p_O) + rise};
  }

  // Adds the plane of the surface that blocks the segment at p_O: its tangent plane there, at the
  // rest height. At a singular point, which has no normal, the direction from the tool to the proxy
  // serves. Returns false if an equal plane is there that bounds the proxy as far.
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
    // At most three planes hold the proxy, so one of the four is idle; the new one takes its place.
    const auto holding_end = holding_.begin() + rest_.planes;
    std::size_t idle = 0;
    while (std::find(holding_.begin(), holding_end, idle) != holding_end) {
      ++idle;
    }
    planes_[idle] = plane;
    return true;
  }

  // Moves to the sub-goal, or as far as the segment is free. Returns true when the tick is over.
  //
  // A wall that stops the segment at once adds its plane, and the sub-goal is chosen again with it:
  // two walls of a crease give the goal on the line of the crease.
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

  // Glides toward a goal on the tangent plane, and returns true if it could. The sample at the end
  // is kept, so that the next sub-goal need not evaluate F there again.
  bool glide_toward(const Vec3& goal) {
    const auto to = glide(field_, {.from = here_, .goal = goal, .tool = h_});
    if (to) {
      move_to(to->point);
      here_ = *to;
      is_sampled_ = true;
    }
    return to.has_value();
  }

  // Chooses the next sub-goal: the tool's projection on the planes, held back by friction. It sets
  // the active planes and their joint normal, n = sum of pressure times plane normal, made unit.
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

  // Draws the goal back to the friction circle, whose radius is mu times the depth of the tool
  // below the planes (friction/cone.h). The rule is applied in metres of the world, relative to the
  // goal. A proxy that slipped in this tick stays in the state `slip` in the rest of it.
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
                         (goal - state_.p_O).norm() * surface_.scale_m <= kLeastMove_m;
    return {.point = goal, .settled = settled};
  }

  // Lets the goal lag behind the tool by what a friction model says: F = K lag along the surface.
  Goal lag_behind(const PlaneProjection& projection, double push_m) {
    const FrictionLag lag = state_.model.lag(sliding_surface(material_), rest_.normal_W,
                                             material_.stiffness_N_per_m * push_m);
    state_.friction = lag.state;
    lag_O_ = surface_.R_WO.transpose() * (lag.lag_m / surface_.scale_m);
    const Vec3 goal = projection.point - lag_O_;
    const bool settled =
        !projection.feasible || (goal - state_.p_O).norm() * surface_.scale_m <= kLeastMove_m;
    return {.point = goal, .settled = settled};
  }

  ImplicitProxyState& state_;
  const ImplicitSurface& surface_;
  const Material& material_;
  const Vec3 h_;
  ImplicitField field_;
  ImplicitRest rest_;
  // F at the proxy, valid if is_sampled_.
  ImplicitSample here_;
  bool is_sampled_ = false;
  // The least distance from the lagging tool in this contact, the place where that was, and the
  // sub-goals since it last fell.
  double nearest_m_ = std::numeric_limits<double>::infinity();
  Vec3 best_ = Vec3::Zero();
  int stalled_ = 0;
  // The proxy slipped in this tick.
  bool slipped_ = false;
  // The proxy rose from where the sign of F is in doubt; this happens once a tick.
  bool has_risen_ = false;
  std::array<Plane, kMostPlanes> planes_;
  std::size_t plane_count_ = 0;
  // The indices in planes_ of the active planes, the first rest_.planes of them.
  std::array<std::size_t, 3> holding_{};
  // The lag of the tool's nearest point that a friction model asks for; zero otherwise.
  Vec3 lag_O_ = Vec3::Zero();
};

}  // namespace

void ImplicitTracker::place(const Vec3& p_W) {
  p_W_ = p_W;
  placed_ = false;
  state_ = {};
}

ImplicitRest ImplicitTracker::advance(const ImplicitSurface& surface, const Material& material,
                                      const Vec3& h_W, std::size_t budget) {
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
  rest = Tick(state_, surface, material, surface.to_object(h_W), budget).run();
  p_W_ = surface.to_world(state_.p_O);
  rest.proxy_W = p_W_;
  rest.friction = state_.friction;
  rest.depth_m = rest.planes > 0 ? (p_W_ - h_W).dot(rest.normal_W) : 0.0;
  return rest;
}

}  // namespace tactus::rendering
