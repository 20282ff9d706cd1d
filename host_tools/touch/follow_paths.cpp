#include "host_tools/touch/follow_paths.h"

#include <vector>

namespace tactus::host {

void follow_paths(rendering::World& world, const ToolPaths& paths, std::deque<ToolRecord>& records,
                  const std::function<void(std::size_t ticks)>& progress) {
  constexpr std::size_t kTicksBetweenSteps = 4096;
  std::vector<rendering::ToolState> tools(paths.tools());
  std::vector<rendering::Touch> touches(paths.tools());
  std::vector<rendering::TickWatcher*> watchers(paths.tools());
  for (std::size_t tick = 0; tick < paths.size(); ++tick) {
    if (tick > 0) {
      world.set_tick(paths.step_s(tick));
    }
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
