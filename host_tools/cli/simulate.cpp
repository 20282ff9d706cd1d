#include "host_tools/cli/simulate.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {

std::vector<RunSummary> simulate(std::string_view verb, const std::filesystem::path& scene_file,
                                 const RunOptions& options, const SimFiles& files) {
  const MappedScene scene(scene_file);
  const auto objects = scene.image().objects();
  const double tool_radius_m = scene.image().tool_radius_m();
  RunPlan plan = plan_run(options, objects, tool_radius_m);
  plan.devices.front().world = rendering::world_of(scene.image());
  for (const std::string& warning : plan.warnings) {
    fmt::print(stderr, "tactus {}: warning: {}\n", verb, warning);
  }
  Simulation simulation(plan.devices, objects, tool_radius_m);
  SimOutputs outputs(files, plan.seconds, simulation, scene);
  std::vector<RunSummary> summaries = run(
      simulation, plan.seconds, options.rate_hz, [&](const Simulation& now) { outputs.add(now); },
      [&](const Simulation& now) { outputs.begin_tick(now); });
  outputs.close();
  return summaries;
}

}  // namespace tactus::host
