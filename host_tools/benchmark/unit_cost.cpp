#include "host_tools/benchmark/unit_cost.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <vector>

#include "host_tools/benchmark/benchmark_mesh.h"
#include "host_tools/benchmark/workload.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

constexpr double kToolRadius_m = 0.002;

// The cost and the time of the same tick in several runs.
struct TimedTick {
  std::size_t units = 0;
  double least_ns = std::numeric_limits<double>::infinity();
};

}  // namespace

double measured_unit_cost_ns() {
  constexpr int kLevel = 5;
  constexpr std::size_t kTicks = 4000;
  constexpr int kRuns = 5;
  const BenchmarkMesh ball = sphere_mesh(kLevel);
  const std::array objects{object_of(ball, true)};
  const std::vector<Vec3> path = stroke_workload(objects[0].mesh, kToolRadius_m, kTicks);
  const auto world = std::make_unique<rendering::World>();
  std::vector<TimedTick> ticks(kTicks);
  for (int run = 0; run < kRuns; ++run) {
    world->set_scene(objects, {.tool_radius_m = kToolRadius_m});
    for (std::size_t i = 0; i < kTicks; ++i) {
      const auto before = std::chrono::steady_clock::now();
      world->touch({.p_W = path[i]});
      const std::chrono::duration<double, std::nano> time =
          std::chrono::steady_clock::now() - before;
      ticks[i].units = world->spent_units();
      ticks[i].least_ns = std::min(ticks[i].least_ns, time.count());
    }
  }
  std::size_t units = 0;
  double time_ns = 0.0;
  for (const TimedTick& tick : ticks) {
    units += tick.units;
    time_ns += tick.least_ns;
  }
  return time_ns / static_cast<double>(units);
}

}  // namespace tactus::host
