#include "host_tools/compare/compared_run.h"

#include <fmt/format.h>

#include <memory>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/input_error.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"

namespace tactus::host {

ComparedRun follow(const std::string& name, const SceneDescription& scene, const ToolPath& path,
                   const Progress& progress) {
  const BakedImage baked = bake_scene(scene, progress);
  const auto image = rendering::SceneImage::open(baked.bytes);
  if (!image) {
    throw InputError(fmt::format("{}: {}: {}", scene.file, name, explain(image.error())));
  }
  const auto world = std::make_unique<rendering::World>();
  if (!world->set_scene(image->objects(), rendering::world_of(*image))) {
    throw InputError(fmt::format("{}: {}: the world refuses the scene", scene.file, name));
  }
  ComparedRun run{.name = name, .ticks = {}};
  run.ticks.reserve(path.size());
  constexpr std::size_t kTicksBetweenSteps = 4096;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const rendering::ToolState tool = path.tool(k);
    world->set_tick(path.step_s(k));
    run.ticks.push_back(
        {.t_s = path.time_s(k), .tool_W = tool.p_W, .touch = world->touch(tool, nullptr)});
    if (progress && k % kTicksBetweenSteps == 0) {
      progress(fmt::format("{}: {} of {} ticks", name, k, path.size()));
    }
  }
  return run;
}

}  // namespace tactus::host
