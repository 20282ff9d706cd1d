#include "firmware/telemetry/tick_explainer.h"

#include <algorithm>
#include <span>

#include "rendering/objects/movers.h"

namespace tactus::firmware {
namespace {

using rendering::ContactKind;
using rendering::TickStep;

Vec3 vector_of(const Triple& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void TickExplainer::begin(NowNs now_ns) {
  timer_ = StepTimer(now_ns);
  explanation_ = {};
  hardest_.reset();
  held_by_.reset();
  walks_ = 0;
}

Explanation TickExplainer::finish(const TelemetryRecord& record, std::int64_t time_ns,
                                  double tool_radius_m) {
  explanation_.tick = record.tick;
  explanation_.time_ns = time_ns;
  explanation_.friction = record.friction;
  explanation_.tool_W = record.tool_p_W;
  explanation_.proxy_W = record.proxy_W;
  explanation_.surface_W = record.proxy_W;
  explanation_.normal_W = record.normal_W;
  explanation_.depth_m = record.depth_m;
  if (record.contact != ContactKind::none) {
    place_contact(record, tool_radius_m);
  }
  explanation_.step_ns = timer_.times(record.stage_ns);
  return explanation_;
}

// The touch names the kind of contact and the object; the watched places of that object add its
// numbers. The proxy of an object beside the shared one is a point.
void TickExplainer::place_contact(const TelemetryRecord& record, double tool_radius_m) {
  explanation_.feature = {.object = record.object, .kind = record.contact};
  const bool is_held = held_by_ && held_by_->feature.object == record.object;
  const auto walks = std::span(walked_to_).first(walks_);
  const auto walked = std::ranges::find(walks, record.object, &rendering::ExplainedFeature::object);
  explanation_.is_feature_known = is_held || walked != walks.end();
  if (explanation_.is_feature_known) {
    explanation_.feature = is_held ? held_by_->feature : *walked;
  }
  const bool is_point = explanation_.iterations > 0 || walks_ > 0;
  const Vec3 below =
      vector_of(record.proxy_W) - (is_point ? 0.0 : tool_radius_m) * vector_of(record.normal_W);
  explanation_.surface_W = to_triple(is_held ? held_by_->surface_W : below);
}

void TickExplainer::see(const rendering::WatchedSubGoal& sub_goal) {
  timer_.end(TickStep::proxy);
  ++explanation_.moves;
  take_planes(sub_goal, constraints_of(sub_goal));
  timer_.skip();
}

void TickExplainer::take_planes(const rendering::WatchedSubGoal& sub_goal,
                                const rendering::WatchedConstraints& constraints) {
  const Vec3& p_W = sub_goal.proxy.state.p_W;
  const rendering::PlaneProjection& projection = constraints.active.projection;
  const rendering::ContactPlanes& planes = constraints.planes;
  explanation_.plane_count = 0;
  hardest_.reset();
  double most_m = 0.0;
  std::size_t hardest = planes.all().size();
  for (std::size_t i = 0; i < projection.active_count; ++i) {
    const std::size_t number = projection.active[i];
    const rendering::ContactPlane& plane = planes[number];
    const rendering::Plane& half_space = plane.plane;
    const Vec3 surface_W = surface_of(plane, p_W);
    const ActivePlane active{
        .feature = feature_of(sub_goal.tick.near.scene, plane, surface_W),
        .normal_W = to_triple(half_space.normal),
        .tool_distance_m = half_space.normal.dot(sub_goal.tick.h_W) - half_space.offset,
        .multiplier_m = projection.pressure_m[i]};
    explanation_.planes[explanation_.plane_count++] = active;
    // The first in the list counts where planes push equally.
    if (active.multiplier_m > most_m || (active.multiplier_m == most_m && number < hardest)) {
      most_m = active.multiplier_m;
      hardest = number;
      hardest_ = Place{.feature = active.feature, .surface_W = surface_W};
    }
  }
  explanation_.has_circle = constraints.circle.has_value();
  explanation_.circle = constraints.circle.value_or(rendering::ExplainedCircle{});
}

void TickExplainer::see_end(const rendering::MovingProxy& /*proxy*/, bool /*is_put_back*/) {
  timer_.end(TickStep::proxy);
  held_by_ = hardest_;
}

void TickExplainer::see(const rendering::WatchedObject& /*object*/,
                        const rendering::WatchedFormulaStep& /*step*/) {
  timer_.end(TickStep::proxy);
  ++explanation_.iterations;
}

void TickExplainer::see(const rendering::WatchedObject& object,
                        const rendering::MeshFeature& feature) {
  timer_.end(TickStep::proxy);
  if (walks_ < walked_to_.size()) {
    walked_to_[walks_++] = feature_of(object, feature);
  }
  timer_.skip();
}

void TickExplainer::see(const rendering::WatchedObject& object,
                        const rendering::WatchedSegment& segment) {
  timer_.end(TickStep::collision);
  ++explanation_.moves;
  explanation_.plane_count = 0;
  explanation_.has_circle = false;
  explanation_.circle = {};
  if (segment.hit.is_hit()) {
    const rendering::ExplainedFeature facet = feature_of(object, segment.hit);
    const double tool_m = segment.hit.normal.dot(segment.tool_O - segment.hit.point);
    explanation_.planes[explanation_.plane_count++] = {
        .feature = facet,
        .normal_W = to_triple(rendering::direction_from(object.mover, segment.hit.normal)),
        .tool_distance_m = tool_m,
        .multiplier_m = -tool_m};
    held_by_ = Place{.feature = facet,
                     .surface_W = rendering::point_from(object.mover, segment.hit.point)};
  }
  timer_.skip();
}

}  // namespace tactus::firmware
