#include "rendering/effects/effect.h"

#include <algorithm>
#include <cmath>

#include "rendering/effects/law_checks.h"

namespace tactus::rendering {
namespace {

// base + s extra with the largest s in [0, 1] that keeps its length within `most`; |base| <= most.
Vec3 add_within(const Vec3& base, const Vec3& extra, double most) {
  if ((base + extra).squaredNorm() <= most * most) {
    return base + extra;
  }
  const double a = extra.squaredNorm();
  if (!(a > 0.0)) {
    return base;
  }
  const double b = base.dot(extra);
  const double room = std::max(0.0, most * most - base.squaredNorm());
  // The positive root of a s^2 + 2 b s = room, in the form that does not cancel.
  const double root = std::sqrt(b * b + a * room);
  const double s = b > 0.0 ? room / (b + root) : (root - b) / a;
  return base + std::clamp(s, 0.0, 1.0) * extra;
}

}  // namespace

bool valid(const Effect& effect) {
  return std::isfinite(effect.max_force_N) && effect.max_force_N > 0.0 &&
         visit_alternative(effect.law, [](const auto& law) { return valid_law(law); });
}

Vec3 apply(const Effect& effect, EffectState& state, const ToolState& tool, double dt_s) {
  if (state.started) {
    state.delivered_J += state.held_force_W.dot(tool.p_W - state.last_tool_W);
  } else {
    state.anchor_W = tool.p_W;
    state.started = true;
  }
  const LawInput input{
      .tool = tool, .state = state, .dt_s = dt_s, .max_force_N = effect.max_force_N};
  const LawForce force =
      visit_alternative(effect.law, [&](const auto& law) { return force_of(law, input); });
  state.last_tool_W = tool.p_W;
  state.held_force_W = add_within(force.elastic_W, force.damping_W, effect.max_force_N);
  return state.held_force_W;
}

double stored_J(const Effect& effect, const EffectState& state, const Vec3& p_W) {
  const LawPlace place{.state = state, .p_W = p_W, .max_force_N = effect.max_force_N};
  return visit_alternative(effect.law, [&](const auto& law) { return stored_by(law, place); });
}

LawSlopes steepest(const Effect& effect) {
  return visit_alternative(effect.law,
                           [&](const auto& law) { return steepest_of(law, effect.max_force_N); });
}

}  // namespace tactus::rendering
