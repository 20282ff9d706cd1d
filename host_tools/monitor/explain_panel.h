// The panel of the monitor that explains the newest tick.
#pragma once

#include <cstddef>

#include "firmware/telemetry/explanation.h"
#include "host_tools/monitor/canvas.h"

namespace tactus::host {

// Draws seven rows from `row` on: the feature, the surface contact point, the active planes and the
// friction circles at the left, and from the column `right` on the times of the loop's steps.
void draw_explanation(Canvas& canvas, std::size_t row, std::size_t right,
                      const firmware::Explanation& explanation);

}  // namespace tactus::host
