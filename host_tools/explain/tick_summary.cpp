#include "host_tools/explain/tick_summary.h"

#include <algorithm>
#include <span>
#include <utility>

namespace tactus::host {
namespace {

using firmware::Explanation;
using firmware::to_triple;
using rendering::ContactKind;

// Sets the touched feature. The shared proxy, or the last facet of a textbook's method, comes
// before a feature walk.
void set_feature(const ExplainedTick& tick, Explanation& summary) {
  const std::uint32_t object = tick.touch.object;
  const auto walked = std::ranges::find(tick.walked_to, object, &ExplainedFeature::object);
  const bool is_held = tick.feature && tick.feature->object == object;
  summary.is_feature_known = is_held || walked != tick.walked_to.end();
  summary.feature = {.object = object, .kind = tick.touch.contact};
  if (summary.is_feature_known) {
    summary.feature = is_held ? *tick.feature : *walked;
  }
  summary.surface_W = to_triple(tick.surface_W);
}

// Sets the active planes, in any order, and the circles of the last move.
void set_move(const ExplainedMove& move, Explanation& summary) {
  for (const ExplainedPlane& plane : move.planes) {
    if (plane.fate == PlaneFate::active && summary.plane_count < firmware::kMaxActivePlanes) {
      summary.planes[summary.plane_count++] = {.feature = plane.feature,
                                               .normal_W = to_triple(plane.normal_W),
                                               .tool_distance_m = plane.tool_distance_m,
                                               .multiplier_m = plane.multiplier_m};
    }
  }
  summary.has_circle = move.circle.has_value();
  summary.circle = move.circle.value_or(ExplainedCircle{});
}

// Returns true if each active plane of one is a plane of the other, too.
bool same_planes(const Explanation& a, const Explanation& b) {
  const auto here = std::span(a.planes).first(a.plane_count);
  const auto there = std::span(b.planes).first(b.plane_count);
  return std::ranges::is_permutation(here, there);
}

}  // namespace

Explanation summary_of(const ExplainedTick& tick) {
  Explanation summary{.tick = tick.number,
                      .friction = tick.touch.friction,
                      .moves = static_cast<std::uint16_t>(tick.moves.size()),
                      .iterations = static_cast<std::uint16_t>(tick.iterations.size()),
                      .tool_W = to_triple(tick.tool_W),
                      .proxy_W = to_triple(tick.touch.proxy_W),
                      .surface_W = to_triple(tick.touch.proxy_W),
                      .normal_W = to_triple(tick.touch.normal_W),
                      .depth_m = tick.touch.depth_m,
                      .step_ns = tick.step_ns.value_or(firmware::StepTimes{})};
  if (tick.touch.contact != ContactKind::none) {
    set_feature(tick, summary);
  }
  if (!tick.moves.empty()) {
    set_move(tick.moves.back(), summary);
  }
  return summary;
}

std::string_view first_difference(const Explanation& a, const Explanation& b) {
  const auto fields = std::to_array<std::pair<std::string_view, bool>>({
      {"tick", a.tick == b.tick},
      {"feature", a.feature == b.feature && a.is_feature_known == b.is_feature_known},
      {"friction", a.friction == b.friction},
      {"moves", a.moves == b.moves},
      {"iterations", a.iterations == b.iterations},
      {"tool", a.tool_W == b.tool_W},
      {"proxy", a.proxy_W == b.proxy_W},
      {"surface", a.surface_W == b.surface_W},
      {"normal", a.normal_W == b.normal_W},
      {"depth", a.depth_m == b.depth_m},
      {"planes", same_planes(a, b)},
      {"circle", a.has_circle == b.has_circle && a.circle == b.circle},
  });
  const auto differs = std::ranges::find(fields, false, &std::pair<std::string_view, bool>::second);
  return differs == fields.end() ? std::string_view{} : differs->first;
}

}  // namespace tactus::host
