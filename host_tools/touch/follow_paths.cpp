#include "host_tools/touch/follow_paths.h"

#include <fmt/format.h>

#include <vector>

#include "host_tools/input_error.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {

std::unique_ptr<rendering::WorldOf<rendering::kMaxTools>> world_of_tools(
    const rendering::SceneImage& scene, std::size_t tools, const std::string& name) {
  auto world = std::make_unique<rendering::WorldOf<rendering::kMaxTools>>();
  rendering::WorldConfig config = rendering::world_of(scene);
  config.tool_count = tools;
  if (!world->set_scene(scene.objects(), config)) {
    throw InputError(fmt::format("{}: the world refuses the scene; bake it again", name));
  }
  return world;
}

void follow_paths(rendering::World& world, const ToolPaths& paths, const TickWork& work) {
  std::vector<rendering::ToolState> tools(paths.tools());
  std::vector<rendering::Touch> touches(paths.tools());
  std::vector<rendering::TickWatcher*> watchers(paths.tools());
  const bool has_bodies = !world.bodies().bodies().empty();
  for (std::size_t tick = 0; tick < paths.size(); ++tick) {
    // Bodies move by the step from their first tick on.
    if (tick > 0 || has_bodies) {
      world.set_tick(paths.step_s(tick));
    }
    if (work.before) {
      work.before(paths.time_s(tick));
    }
    for (std::size_t i = 0; i < paths.tools(); ++i) {
      tools[i] = paths.tool(i, tick);
      watchers[i] = work.watcher ? work.watcher(i) : nullptr;
    }
    world.touch(tools, touches, watchers);
    if (work.after) {
      work.after({.tick = tick, .t_s = paths.time_s(tick), .tools = tools, .touches = touches});
    }
  }
}

void follow_paths(rendering::World& world, const ToolPaths& paths, std::deque<ToolRecord>& records,
                  BodyFiles& bodies, const std::function<void(std::size_t ticks)>& progress) {
  constexpr std::size_t kTicksBetweenSteps = 4096;
  follow_paths(world, paths,
               {.before = [&](double t_s) { bodies.add(t_s, world); },
                .watcher = [&](std::size_t tool) { return records[tool].begin(); },
                .after =
                    [&](const FollowedTick& now) {
                      for (std::size_t i = 0; i < records.size(); ++i) {
                        records[i].add(now.tick, now.t_s, now.tools[i], now.touches[i]);
                      }
                      if (now.tick % kTicksBetweenSteps == 0) {
                        progress(now.tick);
                      }
                    }});
}

}  // namespace tactus::host
