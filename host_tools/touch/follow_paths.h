// The loop of `tactus touch`: all tools follow their paths through one world.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "host_tools/touch/body_files.h"
#include "host_tools/touch/tool_paths.h"
#include "host_tools/touch/tool_record.h"
#include "rendering/limits.h"
#include "rendering/scene/scene_image.h"
#include "rendering/world/world.h"

namespace tactus::host {

// Returns a world with the scene and that many tools; the image must outlive it. Throws InputError,
// which begins with `name`, if the world refuses the scene.
std::unique_ptr<rendering::WorldOf<rendering::kMaxTools>> world_of_tools(
    const rendering::SceneImage& scene, std::size_t tools, const std::string& name);

// A tick that all tools have made; the spans have one entry for each tool.
struct FollowedTick {
  std::size_t tick = 0;
  double t_s = 0.0;
  std::span<const rendering::ToolState> tools;
  std::span<const rendering::Touch> touches;
};

// The work around each tick; a part that is empty is left out.
struct TickWork {
  // Is called with the tick's time before the tick.
  std::function<void(double t_s)> before;
  // Returns what watches a tool's next tick; null if nothing does.
  std::function<rendering::TickWatcher*(std::size_t tool)> watcher;
  // Gets the tick.
  std::function<void(const FollowedTick& tick)> after;
};

// Steps the world once a row of the paths, with all tools. The world has the scene and as many
// tools.
void follow_paths(rendering::World& world, const ToolPaths& paths, const TickWork& work);

// Does the same, and adds each tick to the records, one for each tool, and the bodies at its
// beginning to `bodies`. `progress` hears the number of ticks that are done, now and then. Throws
// InputError if a file cannot be written.
void follow_paths(rendering::World& world, const ToolPaths& paths, std::deque<ToolRecord>& records,
                  BodyFiles& bodies, const std::function<void(std::size_t ticks)>& progress);

}  // namespace tactus::host
