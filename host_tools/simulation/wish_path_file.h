// Wish paths from a file, and the one that is used without a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/simulation/wish_path.h"
#include "rendering/world/object.h"

namespace tactus::host {

// Columns t_s,x_m,y_m,z_m. Errors are one line for a user that names file, line and column.
WishPath read_wish_path(const std::filesystem::path& file);

// Ten seconds made from the scene: wait in front of it (toward the user) while the device homes,
// approach, press on the front, stroke sideways twice along it, leave and hover. `press_m` is how
// far the wish lies below the surface, and no waypoint is further than `reach_m` from the path's
// middle along x or y.
WishPath default_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                           double press_m, double reach_m);

}  // namespace tactus::host
