#include "host_tools/touch/follow_paths.h"

#include <vector>

namespace tactus::host {

void follow_paths(rendering::World& world, const ToolPaths& paths, std::deque<ToolRecord>& records,
                  BodyFiles& bodies, const std::function<void(std::size_t ticks)>& progress) {
  constexpr std::size_t kTicksBetweenSteps = 4096;
  std::vector<rendering::ToolState> tools(paths.tools());
  std::vector<rendering::Touch> touches(paths.tools());
  std::vector<rendering::TickWatcher*> watchers(paths.tools());
  const bool has_bodies = !world.bodies().bodies().empty();
  for (std::size_t tick = 0; tick < paths.size(); ++tick) {
    // Bodies move by the step from their first tick on.
    if (tick > 0 || has_bodies) {
      world.set_tick(paths.step_s(tick));
    }
    bodies.add(paths.time_s(tick), world);
    for (std::size_t i = 0; i < paths.tools(); ++i) {
      tools[i] = paths.tool(i, tick);
      watchers[i] = records[i].begin();
    }
    world.touch(tools, touches, watchers);
    for (std::size_t i = 0; i < paths.tools(); ++i) {
      records[i].add(tick, paths.time_s(tick), tools[i], touches[i]);
    }
    if (tick % kTicksBetweenSteps == 0) {
      progress(tick);
    }
  }
}

}  // namespace tactus::host
