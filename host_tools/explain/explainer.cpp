#include "host_tools/explain/explainer.h"

#include <algorithm>
#include <array>

#include "rendering/contact/active_constraints.h"
#include "rendering/contact/implicit_sample.h"
#include "rendering/contact/sub_goal.h"
#include "rendering/limits.h"
#include "rendering/objects/movers.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::host {
namespace {

using rendering::ContactKind;
using rendering::ContactPlane;
using rendering::TickStep;
using rendering::WatchedConstraints;

// A goal that is nearer to a plane than this is on it, m.
constexpr double kOnPlane_m = 1e-9;

// Returns all planes of a move, which has these constraints.
std::vector<ExplainedPlane> planes_of(const rendering::WatchedSubGoal& sub_goal,
                                      const WatchedConstraints& constraints) {
  const rendering::PlaneProjection& projection = constraints.active.projection;
  const Vec3& p_W = sub_goal.proxy.state.p_W;
  const auto planes = sub_goal.proxy.planes.all();
  std::vector<ExplainedPlane> explained;
  explained.reserve(planes.size());
  for (const ContactPlane& plane : planes) {
    const Vec3 surface_W = surface_of(plane, p_W);
    const rendering::Plane& half_space = plane.plane;
    const double goal_m = half_space.normal.dot(projection.point) - half_space.offset;
    explained.push_back(
        {.feature = feature_of(sub_goal.tick.near.scene, plane, surface_W),
         .surface_W = surface_W,
         .normal_W = half_space.normal,
         .tool_distance_m = half_space.normal.dot(sub_goal.tick.h_W) - half_space.offset,
         .goal_distance_m = goal_m,
         .fate = goal_m > kOnPlane_m ? PlaneFate::not_reached : PlaneFate::redundant});
  }
  for (std::size_t i = 0; i < projection.active_count; ++i) {
    explained[projection.active[i]].multiplier_m = projection.pressure_m[i];
    explained[projection.active[i]].fate = PlaneFate::active;
  }
  return explained;
}

// Returns what stops the move before its goal, if a surface does.
std::optional<ExplainedFeature> stop_of(const rendering::WatchedSubGoal& sub_goal) {
  const rendering::SweepResult& sweep = sub_goal.move.sweep;
  if (sweep.ends_at != rendering::kNoCandidate) {
    const rendering::Candidate& met = sub_goal.tick.near.candidates.candidate(sweep.ends_at);
    return ExplainedFeature{.object = met.object, .kind = ContactKind::face, .face = met.index};
  }
  if (sweep.beyond.object != rendering::kNoObject) {
    return ExplainedFeature{
        .object = sweep.beyond.object, .kind = ContactKind::face, .face = sweep.beyond.triangle};
  }
  return std::nullopt;
}

MoveEnding ending_of(const rendering::NextMove& move, bool is_stopped) {
  if (move.goal.settled) {
    return MoveEnding::settled;
  }
  if (move.sweep.arrived) {
    return MoveEnding::arrived;
  }
  if (!(move.sweep.travel_m > 0.0)) {
    return MoveEnding::held;
  }
  return is_stopped ? MoveEnding::stopped : MoveEnding::border;
}

IterationEnding ending_of(const rendering::WatchedFormulaStep& step) {
  if ((step.flags & rendering::kTouchIterationsExhausted) != 0) {
    return IterationEnding::cut;
  }
  if (step.planes == 0) {
    return IterationEnding::free;
  }
  if (step.from_O == step.to_O) {
    return IterationEnding::settled;
  }
  return step.to_O == step.goal_O ? IterationEnding::arrived : IterationEnding::stopped;
}

}  // namespace

void Explainer::begin() {
  tick_ = {.friction_before = last_friction_};
  passes_ = 0;
  is_moving_ = false;
  timer_.begin();
}

const ExplainedTick& Explainer::finish(std::uint64_t number, double t_s, const Vec3& tool_W,
                                       const rendering::Touch& touch,
                                       const firmware::StageTimes& stage_ns) {
  tick_.number = number;
  tick_.t_s = t_s;
  tick_.tool_W = tool_W;
  tick_.from_W = has_last_ ? last_proxy_W_ : tool_W;
  tick_.touch = touch;
  if (!tick_.feature || tick_.feature->object != touch.object) {
    const bool is_point = !tick_.iterations.empty() || !tick_.walked_to.empty();
    tick_.surface_W = touch.proxy_W - (is_point ? 0.0 : tool_radius_m_) * touch.normal_W;
  }
  if (has_clock_) {
    tick_.step_ns = timer_.times(stage_ns);
  }
  last_proxy_W_ = touch.proxy_W;
  last_friction_ = touch.friction;
  has_last_ = true;
  return tick_;
}

void Explainer::see(const rendering::WatchedSubGoal& sub_goal) {
  timer_.end(TickStep::proxy);
  const rendering::MovingProxy& proxy = sub_goal.proxy;
  end_move(proxy.state.p_W, sub_goal.is_put_back);
  const WatchedConstraints constraints = constraints_of(sub_goal);
  ExplainedMove move{.pass = passes_,
                     .tool_W = sub_goal.move.goal.tool,
                     .from_W = proxy.state.p_W,
                     .goal_W = sub_goal.move.goal.point,
                     .stopped_by = stop_of(sub_goal),
                     .planes = planes_of(sub_goal, constraints),
                     .friction_before = tick_.moves.empty() || tick_.moves.back().pass != passes_
                                            ? tick_.friction_before
                                            : tick_.moves.back().friction,
                     .friction = proxy.state.friction,
                     .circle = constraints.circle};
  move.ending = ending_of(sub_goal.move, move.stopped_by.has_value());
  if (move.circle && !(move.circle->static_radius_m > 0.0)) {
    move.friction = rendering::FrictionState::free;
  }
  tick_.moves.push_back(std::move(move));
  is_moving_ = true;
  timer_.skip();
}

void Explainer::see_end(const rendering::MovingProxy& proxy, bool is_put_back) {
  timer_.end(TickStep::proxy);
  end_move(proxy.state.p_W, is_put_back);
  ++passes_;
  const rendering::ProxyRest& rest = proxy.rest;
  if ((rest.flags & rendering::kTouchIterationsExhausted) != 0 && !tick_.moves.empty() &&
      tick_.moves.back().to_W == tick_.moves.back().from_W) {
    tick_.moves.back().ending = MoveEnding::cut;
  }
  const std::vector<ExplainedPlane>* const planes =
      tick_.moves.empty() ? nullptr : &tick_.moves.back().planes;
  tick_.feature.reset();
  if (planes != nullptr && !planes->empty()) {
    const ExplainedPlane& hardest =
        *std::ranges::max_element(*planes, {}, &ExplainedPlane::multiplier_m);
    if (hardest.multiplier_m > 0.0) {
      tick_.feature = hardest.feature;
      tick_.surface_W = hardest.surface_W;
    }
  }
  timer_.skip();
}

void Explainer::end_move(const Vec3& p_W, bool is_put_back) {
  if (!is_moving_) {
    return;
  }
  tick_.moves.back().to_W = p_W;
  if (is_put_back && tick_.moves.back().ending != MoveEnding::settled) {
    tick_.moves.back().ending = MoveEnding::put_back;
  }
  is_moving_ = false;
}

void Explainer::see(const rendering::WatchedObject& object,
                    const rendering::WatchedFormulaStep& step) {
  timer_.end(TickStep::proxy);
  const rendering::ImplicitSurface& surface = step.surface;
  const auto to_world = [&](const Vec3& p_O) {
    return rendering::point_from(object.mover, surface.to_world(p_O));
  };
  ExplainedIteration iteration{.object = object.number,
                               .from_W = to_world(step.from_O),
                               .goal_W = to_world(step.goal_O),
                               .to_W = to_world(step.to_O),
                               .ending = ending_of(step),
                               .friction = step.friction};
  if (step.side != 0.0 && surface.bounds_O.contains(step.from_O)) {
    rendering::ImplicitField field(surface, step.side, rendering::kMaxFormulaBudget);
    const rendering::ImplicitSample here = rendering::sample(field, step.from_O);
    iteration.value = here.value;
    iteration.normal_W = rendering::direction_from(object.mover, surface.R_WO * here.normal);
    iteration.height_m = here.height * surface.scale_m;
  }
  tick_.iterations.push_back(iteration);
  timer_.skip();
}

void Explainer::see(const rendering::WatchedObject& object, const rendering::MeshFeature& feature) {
  timer_.end(TickStep::proxy);
  tick_.walked_to.push_back(feature_of(object, feature));
  timer_.skip();
}

void Explainer::see(const rendering::WatchedObject& object,
                    const rendering::WatchedSegment& segment) {
  timer_.end(TickStep::collision);
  const auto to_world = [&](const Vec3& p_O) { return rendering::point_from(object.mover, p_O); };
  ExplainedMove move{.tool_W = to_world(segment.tool_O),
                     .from_W = to_world(segment.from_O),
                     .goal_W = to_world(segment.goal_O),
                     .to_W = to_world(segment.to_O),
                     .ending = MoveEnding::arrived};
  if (segment.hit.is_hit()) {
    const ExplainedFeature facet = feature_of(object, segment.hit);
    const Vec3& normal_O = segment.hit.normal;
    const double tool_m = normal_O.dot(segment.tool_O - segment.hit.point);
    move.ending = MoveEnding::stopped;
    move.stopped_by = facet;
    move.planes.push_back({.feature = facet,
                           .surface_W = to_world(segment.hit.point),
                           .normal_W = rendering::direction_from(object.mover, normal_O),
                           .tool_distance_m = tool_m,
                           .multiplier_m = -tool_m,
                           .fate = PlaneFate::active});
    tick_.feature = facet;
    tick_.surface_W = move.planes.back().surface_W;
  }
  tick_.moves.push_back(std::move(move));
  timer_.skip();
}

}  // namespace tactus::host
