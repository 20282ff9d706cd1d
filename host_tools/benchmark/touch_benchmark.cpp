#include "host_tools/benchmark/touch_benchmark.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "host_tools/benchmark/percentile.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

TouchTiming time_touch(std::span<const rendering::Object> objects, double tool_radius_m,
                       std::span<const Vec3> path) {
  const auto world = std::make_unique<rendering::World>();
  world->set_scene(objects, {.tool_radius_m = tool_radius_m});
  for (const Vec3& p : path.first(std::min<std::size_t>(path.size(), 1000))) {
    world->touch({.p_W = p});
  }
  world->reset();
  TouchTiming timing{.ticks = path.size()};
  std::vector<double> nanoseconds;
  nanoseconds.reserve(path.size());
  for (const Vec3& p : path) {
    const Clock::time_point start = Clock::now();
    const rendering::Touch touch = world->touch({.p_W = p});
    const Clock::time_point end = Clock::now();
    nanoseconds.push_back(std::chrono::duration<double, std::nano>(end - start).count());
    timing.contact_ticks += touch.contact != rendering::ContactKind::none ? 1 : 0;
    timing.flagged_ticks += touch.flags != rendering::kTouchClean ? 1 : 0;
  }
  std::ranges::sort(nanoseconds);
  timing.median_ns = percentile(nanoseconds, 0.5);
  timing.p99_ns = percentile(nanoseconds, 0.99);
  timing.p999_ns = percentile(nanoseconds, 0.999);
  timing.max_ns = nanoseconds.back();
  timing.peak_candidates = world->peak_candidates();
  return timing;
}

}  // namespace tactus::host
