#include "host_tools/plot/tick_view.h"

#include <algorithm>
#include <array>
#include <ranges>

#include "rendering/geometry/tangential.h"

namespace tactus::host {

namespace {

// Returns the tick's contact normal; without contact that of a formula under the proxy, if there is
// one.
std::optional<Vec3> normal_of(const TickSteps& tick) {
  if (tick.normal_W) {
    return tick.normal_W;
  }
  for (const StepMove& move : std::views::reverse(tick.moves)) {
    if (move.formula && move.formula->normal_W) {
      return move.formula->normal_W;
    }
  }
  return std::nullopt;
}

// Returns the middle of the ticks' normals; up if they have none or point all ways.
Vec3 common_normal(std::span<const TickSteps> ticks) {
  constexpr double kNone = 1e-6;
  if (ticks.size() == 1) {
    return normal_of(ticks.front()).value_or(Vec3::UnitY());
  }
  Vec3 sum = Vec3::Zero();
  for (const TickSteps& tick : ticks) {
    sum += tick.normal_W.value_or(Vec3::Zero());
  }
  return sum.norm() > kNone ? sum.normalized() : normal_of(ticks.front()).value_or(Vec3::UnitY());
}

}  // namespace

TickView::TickView(std::span<const TickSteps> ticks, bool from_above)
    : origin_W_(ticks.front().tool_W) {
  // A shorter pull has no direction that could be seen, m.
  constexpr double kShort_m = 1e-7;
  const Vec3 normal = common_normal(ticks);
  const auto touching =
      std::ranges::find_if(ticks, [](const TickSteps& tick) { return tick.surface_W.has_value(); });
  if (touching != ticks.end()) {
    origin_W_ = touching->surface_W.value_or(origin_W_);
  }
  const TickSteps& last = ticks.back();
  const Vec3 pull = last.tool_W - last.proxy_W;
  const Vec3 path = last.proxy_W - ticks.front().from_W;
  const bool is_lone = ticks.size() == 1;
  const std::array<Vec3, 3> pulls{is_lone ? pull : path, is_lone ? path : pull,
                                  normal.unitOrthogonal()};
  for (const Vec3& along : pulls) {
    right_W_ = rendering::tangential(along, normal);
    if (right_W_.norm() > kShort_m) {
      break;
    }
  }
  right_W_.normalize();
  const Vec3 away = normal.cross(right_W_);
  up_W_ = from_above ? away : normal;
  toward_W_ = from_above ? normal : Vec3{-away};
}

Window TickView::window(std::span<const TickSteps> ticks) const {
  // The smallest width, mm, and the window's half width as a share of what it holds.
  constexpr double kLeast_mm = 0.02;
  constexpr double kHalf = 0.62;
  Window window;
  const auto include_around = [&](const Vec3& p_W, double radius_m) {
    const PlanePoint centre = point(p_W);
    const double r = 1e3 * radius_m;
    window.include({.right = centre.right - r, .up = centre.up});
    window.include({.right = centre.right + r, .up = centre.up});
  };
  for (const TickSteps& tick : ticks) {
    for (const Vec3& p_W : {tick.tool_W, tick.from_W, tick.proxy_W, without_friction_W(tick)}) {
      window.include(point(p_W));
    }
    for (const StepMove& move : tick.moves) {
      window.include(point(move.from_W));
      window.include(point(move.to_W));
    }
    include_around(tick.proxy_W, tool_radius_m(tick));
    if (const auto circles = circles_of(tick)) {
      include_around(without_friction_W(tick), circles->first);
    }
  }
  return square_about(window, kHalf, kLeast_mm);
}

double tool_radius_m(const TickSteps& tick) {
  return tick.surface_W ? (tick.proxy_W - *tick.surface_W).norm() : 0.0;
}

std::optional<std::pair<double, double>> circles_of(const TickSteps& tick) {
  for (const StepMove& move : std::views::reverse(tick.moves)) {
    const double static_m = move.static_radius_m.value_or(0.0);
    if (static_m > 0.0) {
      return std::pair{static_m, move.dynamic_radius_m.value_or(0.0)};
    }
  }
  return std::nullopt;
}

Vec3 without_friction_W(const TickSteps& tick) {
  return tick.normal_W ? Vec3{tick.tool_W + tick.depth_m * *tick.normal_W} : tick.tool_W;
}

}  // namespace tactus::host
