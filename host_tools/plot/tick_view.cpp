#include "host_tools/plot/tick_view.h"

#include <algorithm>
#include <array>
#include <ranges>

#include "rendering/geometry/tangential.h"

namespace tactus::host {

TickView::TickView(const TickSteps& tick, bool from_above)
    : origin_W_(tick.surface_W.value_or(tick.tool_W)) {
  // A shorter pull has no direction that could be seen, m.
  constexpr double kShort_m = 1e-7;
  const Vec3 normal = tick.normal_W.value_or(Vec3::UnitY());
  const std::array<Vec3, 3> pulls{tick.tool_W - tick.proxy_W, tick.proxy_W - tick.from_W,
                                  normal.unitOrthogonal()};
  for (const Vec3& pull : pulls) {
    right_W_ = rendering::tangential(pull, normal);
    if (right_W_.norm() > kShort_m) {
      break;
    }
  }
  right_W_.normalize();
  const Vec3 away = normal.cross(right_W_);
  up_W_ = from_above ? away : normal;
  toward_W_ = from_above ? normal : Vec3{-away};
}

Window TickView::window(const TickSteps& tick) const {
  // The smallest width, mm, and the window's half width as a share of what it holds.
  constexpr double kLeast_mm = 0.02;
  constexpr double kHalf = 0.62;
  Window window;
  for (const Vec3& p_W : {tick.tool_W, tick.from_W, tick.proxy_W, without_friction_W(tick)}) {
    window.include(point(p_W));
  }
  for (const StepMove& move : tick.moves) {
    window.include(point(move.from_W));
    window.include(point(move.to_W));
  }
  const auto include_around = [&](const Vec3& p_W, double radius_m) {
    const PlanePoint centre = point(p_W);
    const double r = 1e3 * radius_m;
    window.include({.right = centre.right - r, .up = centre.up});
    window.include({.right = centre.right + r, .up = centre.up});
  };
  include_around(tick.proxy_W, tool_radius_m(tick));
  if (const auto circles = circles_of(tick)) {
    include_around(without_friction_W(tick), circles->first);
  }
  const double half = kHalf * std::max({window.width(), window.height(), kLeast_mm});
  const double right = 0.5 * (window.lower.right + window.upper.right);
  const double up = 0.5 * (window.lower.up + window.upper.up);
  return {.lower = {.right = right - half, .up = up - half},
          .upper = {.right = right + half, .up = up + half},
          .empty = false};
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
