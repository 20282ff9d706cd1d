// Draws the reach of a device, with its resolution and force.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/reach/reach_map.h"
#include "host_tools/reach/scene_reach.h"

namespace tactus::host {

// Draws cuts through the middle of the workspace, seen from the left and from the user (a device of
// two joints from above, one of one joint from the user), each with the resolution and the force in
// colours. `objects` are outlined where they are; there may be none. Throws InputError if gnuplot
// is missing or the picture cannot be written.
void draw_reach(const ReachMap& map, std::span<const ObjectReach> objects, const std::string& title,
                const std::string& subtitle, const std::filesystem::path& picture);

}  // namespace tactus::host
