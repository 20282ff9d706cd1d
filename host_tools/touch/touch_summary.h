// The summary of what one tool felt along its path.
#pragma once

#include <algorithm>
#include <cstddef>

#include "rendering/touch.h"

namespace tactus::host {

// Counts and extremes over all ticks.
struct TouchSummary {
  std::size_t ticks = 0;
  std::size_t contact_ticks = 0;
  // The ticks that gave something up to a limit (rendering/limits.h).
  std::size_t flagged_ticks = 0;
  double max_force_N = 0.0;
  double max_depth_m = 0.0;
  double max_short_of_goal_m = 0.0;

  // Adds one tick.
  void add(const rendering::Touch& touch) {
    ++ticks;
    contact_ticks += touch.contact != rendering::ContactKind::none ? 1 : 0;
    flagged_ticks += touch.flags != rendering::kTouchClean ? 1 : 0;
    max_force_N = std::max(max_force_N, touch.force_W.norm());
    max_depth_m = std::max(max_depth_m, touch.depth_m);
    max_short_of_goal_m = std::max(max_short_of_goal_m, touch.short_of_goal_m);
  }
};

}  // namespace tactus::host
