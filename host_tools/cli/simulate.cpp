#include "host_tools/cli/simulate.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"

namespace tactus::host {

std::vector<RunSummary> simulate(std::string_view verb, const std::filesystem::path& scene_file,
                                 const RunOptions& options, const SimFiles& files) {
  const MappedScene scene(scene_file);
  const RunPlan plan = plan_run(options, scene.image());
  for (const std::string& warning : plan.warnings) {
    fmt::print(stderr, "tactus {}: warning: {}\n", verb, warning);
  }
  Simulation simulation(plan.devices, scene.image().objects(), scene.image().tool_radius_m());
  SimOutputs outputs(files, plan.seconds, simulation, scene);
  std::vector<RunSummary> summaries = run(
      simulation, plan.seconds, options.rate_hz, [&](const Simulation& now) { outputs.add(now); },
      [&](const Simulation& now) { outputs.begin_tick(now); });
  outputs.close();
  return summaries;
}

}  // namespace tactus::host
