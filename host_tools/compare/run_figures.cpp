#include "host_tools/compare/run_figures.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

using rendering::ContactKind;

bool is_in_contact(const ComparedTick& tick) {
  return tick.touch.contact != ContactKind::none;
}

// The proxy and the force of a run at some time.
struct Moment {
  Vec3 proxy_W;
  Vec3 force_W;
};

Moment moment_at(const ComparedRun& run, double t_s) {
  const auto after = std::ranges::lower_bound(run.ticks, t_s, {}, &ComparedTick::t_s);
  if (after == run.ticks.begin() || after == run.ticks.end() || after->t_s == t_s) {
    const ComparedTick& tick = after == run.ticks.end() ? run.ticks.back() : *after;
    return {.proxy_W = tick.touch.proxy_W, .force_W = tick.touch.force_W};
  }
  const auto before = std::prev(after);
  const double share = (t_s - before->t_s) / (after->t_s - before->t_s);
  const auto between = [share](const Vec3& a, const Vec3& b) -> Vec3 {
    return a + share * (b - a);
  };
  return {.proxy_W = between(before->touch.proxy_W, after->touch.proxy_W),
          .force_W = between(before->touch.force_W, after->touch.force_W)};
}

// Sums over the ticks that count, in their order.
struct Sums {
  double moves = 0.0;
  double squared_ripple = 0.0;
  std::size_t ripples = 0;
};

}  // namespace

double distance_from(const ComparedTick& tick, const ComparedRun& other) {
  return (tick.touch.proxy_W - moment_at(other, tick.t_s).proxy_W).norm();
}

RunFigures figures_of(const ComparedRun& run, const ComparedRun& other, const TimeSpan& span) {
  RunFigures figures;
  Sums sums;
  for (std::size_t k = 0; k < run.ticks.size(); ++k) {
    const ComparedTick& tick = run.ticks[k];
    if (!span.holds(tick.t_s)) {
      continue;
    }
    const Vec3& force_W = tick.touch.force_W;
    figures.largest_force_N = std::max(figures.largest_force_N, force_W.norm());
    const Moment there = moment_at(other, tick.t_s);
    figures.off_m = std::max(figures.off_m, (tick.touch.proxy_W - there.proxy_W).norm());
    figures.force_off_N = std::max(figures.force_off_N, (force_W - there.force_W).norm());
    figures.above_m = std::max(figures.above_m, tick.height_m);
    figures.below_m = std::max(figures.below_m, -tick.height_m);
    if (is_in_contact(tick)) {
      ++figures.contact_ticks;
      sums.moves += tick.touch.sub_goals;
      figures.most_moves = std::max<std::size_t>(figures.most_moves, tick.touch.sub_goals);
    }
    if (k == 0 || !span.holds(run.ticks[k - 1].t_s)) {
      continue;
    }
    const ComparedTick& before = run.ticks[k - 1];
    const Vec3 change = force_W - before.touch.force_W;
    figures.breaks += is_in_contact(before) && !is_in_contact(tick) ? 1U : 0U;
    figures.largest_jump_N = std::max(figures.largest_jump_N, change.norm());
    figures.given_out_J += 0.5 * (force_W + before.touch.force_W).dot(tick.tool_W - before.tool_W);
    if (k + 1 < run.ticks.size() && span.holds(run.ticks[k + 1].t_s) && is_in_contact(before) &&
        is_in_contact(tick) && is_in_contact(run.ticks[k + 1])) {
      const Vec3 half = 0.5 * (run.ticks[k + 1].touch.force_W - force_W - change);
      sums.squared_ripple += half.squaredNorm();
      ++sums.ripples;
    }
  }
  if (figures.contact_ticks > 0) {
    figures.mean_moves = sums.moves / static_cast<double>(figures.contact_ticks);
  }
  if (sums.ripples > 0) {
    figures.ripple_N = std::sqrt(sums.squared_ripple / static_cast<double>(sums.ripples));
  }
  return figures;
}

}  // namespace tactus::host
