// One tick of a point proxy p on the implicit surface F = 0, toward the tool h. Everything is in
// the object's frame O, in the formula's own unit of length; a length times `scale_m` is in metres
// of the world. F = side * f is above 0 on the side of the proxy.
//
// Each sub-goal of a tick takes these steps:
//
//   1. If the proxy rests on the surface, the tangent plane there is the active constraint. With
//      n = grad F / |grad F| it is n . x >= n . p + rise, where `rise` brings p to the rest height.
//      The sub-goal is the plane's point nearest to the tool, drawn back to the friction circle
//      (implicit_planes.h, implicit_friction.h).
//   2. On smooth ground the proxy glides: a tangent step corrected for curvature, then back to the
//      surface along the gradient (rendering/contact/implicit_glide.h).
//   3. Elsewhere it sweeps straight to the sub-goal and stops where intervals find the surface. A
//      surface that blocks it at once, such as the second wall of a crease, gives one more plane,
//      and is remembered (crease_walls.h).
//
// Without contact the sub-goal is the tool itself. First contact is found in this manner, and
// contact ends when the tool leaves through the plane: then no plane is active in the projection.
//
// Two things go beyond the paper (see implicit_tracking.h): intervals prove every move free, so the
// proxy crosses nothing thin, and every move along the surface brings it nearer to the tool, so it
// cannot oscillate. ImplicitStall ends the ticks in which the gain is only rounding.
#include "rendering/contact/implicit_tick.h"

#include <optional>
#include <utility>

#include "rendering/contact/implicit_friction.h"
#include "rendering/contact/implicit_glide.h"
#include "rendering/contact/implicit_planes.h"
#include "rendering/contact/implicit_segment.h"
#include "rendering/contact/implicit_stall.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// A surface that stops the proxy within this travel gives a plane at the proxy, and the sub-goal is
// chosen again. After a longer travel the move is made first.
constexpr double kHeld_m = 1e-6;
// A move along the surface that brings the proxy nearer to the tool by less than this is none.
constexpr double kLeastGain_m = 1e-10;
// The planes that may be met without a move, before the sub-goal is given up.
constexpr std::size_t kMostAttempts = 8;

// One tick: the proxy's state, the tool and what the sub-goals pass on to each other.
class ImplicitTick {
 public:
  ImplicitTick(ImplicitProxyState& state, const ImplicitSurface& surface, const Material& material,
               Vec3 h_O, std::size_t budget)
      : state_(state),
        surface_(surface),
        h_(std::move(h_O)),
        field_(surface, 1.0, budget),
        friction_(material) {}

  // Runs the tick. `watch` sees each sub-goal after it.
  template <class Watch>
  ImplicitRest run(const Watch& watch);

 private:
  // Returns what a watcher is shown of the sub-goal that began at `from_O`.
  [[nodiscard]] WatchedFormulaStep watched(const Vec3& from_O) const {
    return {.surface = surface_,
            .side = state_.side,
            .from_O = from_O,
            .goal_O = goal_.point,
            .to_O = state_.p_O,
            .planes = rest_.planes,
            .friction = friction_.seen(state_),
            .flags = rest_.flags};
  }

  // Runs one sub-goal. Returns true when the tick is over, as pass_outside, come_out and go do.
  bool step();
  bool step_in_bounds();

  // The moves where the proxy has no tangent plane.
  bool pass_outside();
  void find_side();
  bool come_out();

  // The moves in contact and toward it. They keep to the side of the surface where the proxy is.
  bool go(const ImplicitSample& here);
  ImplicitGoal choose_goal();
  bool glide_toward(const ImplicitSample& here);
  bool come_to_rest_at(const Vec3& stop);

  // Ends the tick with the proxy where it is known to be free, and returns true. The planes of the
  // last sub-goal stay in the result, so that it still gives the force.
  bool exhausted() {
    rest_.flags |= kTouchIterationsExhausted;
    return true;
  }
  // Returns F at the proxy, valid until the proxy moves.
  const ImplicitSample& sample_here() {
    if (!here_) {
      here_ = sample(field_, state_.p_O);
    }
    return *here_;
  }
  // Returns the distance of a place from the tool, as friction lets it lag.
  [[nodiscard]] double distance_m(const Vec3& p) const {
    return (p - (h_ - friction_.lag_O())).norm() * surface_.scale_m;
  }
  // Moves the proxy; the sample of F at the old place is not valid there.
  void move_to(const Vec3& p) {
    state_.p_O = p;
    here_.reset();
  }
  // Ends the contact: no planes, no normal, no friction.
  void forget_contact() {
    rest_.planes = 0;
    rest_.normal_W = Vec3::Zero();
    state_.friction = FrictionState::free;
    state_.walls.clear();
  }

  ImplicitProxyState& state_;
  const ImplicitSurface& surface_;
  const Vec3 h_;
  ImplicitField field_;
  ImplicitRest rest_;
  // The sub-goal that was chosen last.
  ImplicitGoal goal_;
  // F at the proxy, once it is evaluated there.
  std::optional<ImplicitSample> here_;
  // The planes at the proxy.
  ImplicitPlanes planes_;
  ImplicitFriction friction_;
  ImplicitStall stall_;
  // The proxy rose from where the sign of F is in doubt; this happens once a tick.
  bool has_risen_ = false;
};

// Repeats sub-goals until the tick is over. After a stall the proxy stays where it was nearest to
// the tool, and not where the last swing left it.
template <class Watch>
ImplicitRest ImplicitTick::run(const Watch& watch) {
  const std::size_t budget = field_.left();
  for (bool is_over = false; !is_over;) {
    [[maybe_unused]] const Vec3 from_O = state_.p_O;
    is_over = step();
    if constexpr (Watch::kSees) {
      watch.see(watched(from_O));
    }
    if (!is_over) {
      ++rest_.sub_goals;
    }
  }
  if (rest_.planes > 0 && stall_.has_swung()) {
    state_.p_O = stall_.best_O();
  }
  rest_.evaluated = budget - field_.left();
  return rest_;
}

// The order matters: F is defined within the bounds only, its sign gives the side, and only a
// proxy on a known side at its rest height has a tangent plane.
bool ImplicitTick::step() {
  planes_.clear();
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
  return step_in_bounds();
}

bool ImplicitTick::step_in_bounds() {
  field_.set_side(state_.side);
  const ImplicitSample& here = sample_here();
  // The formula has changed since the last tick, so the side is found anew.
  if (here.value < 0.0) {
    move_to(state_.p_O);
    state_.side = 0.0;
    return false;
  }
  // Nearer to the surface than half the rest height, the sign of F is in doubt: the proxy rises
  // first, once a tick.
  const double height_m = here.height * surface_.scale_m;
  if (height_m < 0.5 * kImplicitRest_m && !has_risen_) {
    has_risen_ = true;
    move_to(raised_to_rest(field_, state_.p_O).value_or(state_.p_O));
    return false;
  }
  if (stall_.note(state_.p_O, height_m, distance_m(state_.p_O))) {
    return true;
  }
  if (height_m <= kImplicitReach_m) {
    planes_.add(tangent_plane(surface_, here));
    state_.walls.add_planes(field_, here, planes_);
  } else {
    state_.walls.clear();
  }
  return go(here);
}

// Moves a proxy outside the bounds, where nothing blocks it: to the tool, or to where the segment
// to the tool enters the bounds.
bool ImplicitTick::pass_outside() {
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
void ImplicitTick::find_side() {
  field_.set_side(1.0);
  state_.side = field_.value(state_.p_O) < 0.0 ? -1.0 : 1.0;
}

// Moves a proxy within a one-sided solid: it stays with the tool, up to where that comes out.
// Seen from inside, the surface blocks a segment where f becomes positive; just beyond it the side
// is found anew.
bool ImplicitTick::come_out() {
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

// Moves to the sub-goal, or as far as the segment is free.
//
// A wall that stops the segment at once adds its plane, and the sub-goal is chosen again with it:
// two walls of a crease give the goal on the line of the crease, and share the friction.
bool ImplicitTick::go(const ImplicitSample& here) {
  for (std::size_t attempt = 0; attempt < kMostAttempts; ++attempt) {
    friction_.begin_choice(state_);
    goal_ = choose_goal();
    if (goal_.settled) {
      return true;
    }
    if (rest_.planes == 1 && planes_.size() == 1 && glide_toward(here)) {
      return false;
    }
    const SweptSegment segment = sweep_segment(field_, state_.p_O, goal_.point, here.value);
    const Crossing& crossing = segment.crossing;
    if (crossing.state == SegmentState::free) {
      move_to(goal_.point);
      return false;
    }
    const Vec3 stop = segment.at(crossing.free_to);
    const bool is_held = crossing.state == SegmentState::blocked &&
                         (stop - state_.p_O).norm() * surface_.scale_m <= kHeld_m;
    const Vec3 wall = segment.at(crossing.blocked_at);
    if (!is_held || !planes_.add(blocking_plane(field_, wall, state_.p_O - h_))) {
      const bool has_moved = come_to_rest_at(stop);
      return !has_moved && (crossing.state == SegmentState::blocked || exhausted());
    }
    state_.walls.add(wall - state_.p_O);
    friction_.take_back(state_);
  }
  return exhausted();
}

// Chooses the next sub-goal: the tool's projection on the planes, held back by friction.
ImplicitGoal ImplicitTick::choose_goal() {
  const ImplicitPush push = planes_.push(h_, surface_);
  rest_.planes = push.projection.active_count;
  rest_.normal_W = push.normal_W;
  if (rest_.planes == 0) {
    state_.friction = FrictionState::free;
    return {.point = h_, .pulled_to = h_, .settled = h_ == state_.p_O};
  }
  return friction_.hold(push, planes_, h_, surface_, state_);
}

// Glides toward the goal on the tangent plane, and returns true if it could. The sample at the end
// is kept, so that the next sub-goal need not evaluate F there again.
bool ImplicitTick::glide_toward(const ImplicitSample& here) {
  const auto to =
      glide(field_, {.from = here, .goal = goal_.point, .pulled_to = goal_.pulled_to, .tool = h_});
  if (to) {
    move_to(to->point);
    here_ = to;
  }
  return to.has_value();
}

// Moves from the end of a segment to the rest height. Returns false, and stays, if that is no
// nearer to the tool than before.
bool ImplicitTick::come_to_rest_at(const Vec3& stop) {
  Vec3 end = raised_to_rest(field_, stop).value_or(stop);
  if (end == stop) {
    const Vec3 up = rest_.planes > 0 ? Vec3{surface_.R_WO.transpose() * rest_.normal_W}
                                     : (state_.p_O - stop).stableNormalized();
    end = raised_from_crease(field_, state_.p_O, stop, up);
  }
  if (distance_m(state_.p_O) - distance_m(end) <= kLeastGain_m) {
    return false;
  }
  move_to(end);
  return true;
}

}  // namespace

template <class Watch>
ImplicitRest run_implicit_tick(ImplicitProxyState& state, const ImplicitSurface& surface,
                               const Material& material, const Vec3& h_O, std::size_t budget,
                               Watch watch) {
  ImplicitTick tick(state, surface, material, h_O, budget);
  return tick.run(watch);
}

template ImplicitRest run_implicit_tick(ImplicitProxyState&, const ImplicitSurface&,
                                        const Material&, const Vec3&, std::size_t, Unwatched);
template ImplicitRest run_implicit_tick(ImplicitProxyState&, const ImplicitSurface&,
                                        const Material&, const Vec3&, std::size_t, ObjectWatched);

}  // namespace tactus::rendering
