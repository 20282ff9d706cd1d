// The loop of `tactus touch`: all tools follow their paths through one world.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>

#include "host_tools/touch/body_files.h"
#include "host_tools/touch/tool_paths.h"
#include "host_tools/touch/tool_record.h"
#include "rendering/world/world.h"

namespace tactus::host {

// Steps the world once a row of the paths, with all tools, and adds each tick to the records, one
// for each tool, and the bodies at its beginning to `bodies`. The world has the scene and as many
// tools. `progress` hears the number of ticks that are done, now and then.
// Throws InputError if a file cannot be written.
void follow_paths(rendering::World& world, const ToolPaths& paths, std::deque<ToolRecord>& records,
                  BodyFiles& bodies, const std::function<void(std::size_t ticks)>& progress);

}  // namespace tactus::host
