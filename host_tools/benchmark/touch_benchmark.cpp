#include "host_tools/benchmark/touch_benchmark.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <vector>

#include "host_tools/benchmark/percentile.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

using Clock = std::chrono::steady_clock;

// Returns the time of one touch, ns, with one reading of the clock in it.
double nanoseconds_of(rendering::World& world, const Vec3& p, rendering::Touch& touch) {
  const Clock::time_point start = Clock::now();
  touch = world.touch({.p_W = p});
  const Clock::time_point end = Clock::now();
  return std::chrono::duration<double, std::nano>(end - start).count();
}

}  // namespace

TouchTiming time_touch(std::span<const rendering::Object> objects, double tool_radius_m,
                       std::span<const Vec3> path, std::size_t runs) {
  const auto world = std::make_unique<rendering::World>();
  world->set_scene(objects, {.tool_radius_m = tool_radius_m});
  for (const Vec3& p : path.first(std::min<std::size_t>(path.size(), 1000))) {
    world->touch({.p_W = p});
  }
  TouchTiming timing{.ticks = path.size()};
  std::vector<double> least(path.size(), std::numeric_limits<double>::infinity());
  std::vector<double> once(path.size());
  for (std::size_t run = 0; run < runs; ++run) {
    world->reset();
    timing.contact_ticks = 0;
    timing.flagged_ticks = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      rendering::Touch touch;
      once[i] = nanoseconds_of(*world, path[i], touch);
      least[i] = std::min(least[i], once[i]);
      timing.contact_ticks += touch.contact != rendering::ContactKind::none ? 1 : 0;
      timing.flagged_ticks += touch.flags != rendering::kTouchClean ? 1 : 0;
    }
  }
  std::ranges::sort(least);
  timing.median_ns = percentile(least, 0.5);
  timing.p99_ns = percentile(least, 0.99);
  timing.p999_ns = percentile(least, 0.999);
  timing.max_ns = least.back();
  std::ranges::sort(once);
  timing.once_p999_ns = percentile(once, 0.999);
  timing.once_max_ns = once.back();
  timing.peak_candidates = world->peak_candidates();
  return timing;
}

}  // namespace tactus::host
