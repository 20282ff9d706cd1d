// Times the touch of objects, tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/objects/object.h"

namespace tactus::host {

struct TouchTiming {
  std::size_t ticks = 0;
  double median_ns = 0.0;
  double p99_ns = 0.0;
  double p999_ns = 0.0;
  double max_ns = 0.0;
  double once_p999_ns = 0.0;  // of one run, with all that interrupted it
  double once_max_ns = 0.0;
  std::size_t contact_ticks = 0;
  std::size_t flagged_ticks = 0;    // with any touch flag
  std::size_t peak_candidates = 0;  // triangles kept near the tool
};

// Touches the objects with a tool that follows `path`, first a little for warming up, then in
// `runs` runs, 1 at least, that do the same work tick by tick. What a tick takes is the least of
// them: what interrupts the processor comes at other ticks in each. Clock reads cost about 20 ns a
// tick and are included.
TouchTiming time_touch(std::span<const rendering::Object> objects, double tool_radius_m,
                       std::span<const Vec3> path, std::size_t runs);

}  // namespace tactus::host
