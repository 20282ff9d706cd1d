// Wish paths from a file, and the one that is used without a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/simulation/wish_path.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Columns t_s,x_m,y_m,z_m. Throws InputError, one line that names file, line and column.
WishPath read_wish_path(const std::filesystem::path& file);

// Ten seconds made from the scene: wait in front of it (toward the user) while the device homes,
// approach, press on the front, stroke sideways to both sides as far as the front goes on, leave
// and hover. `press_m` is how far the wish lies below the surface; along x the path stays within
// `reach_m` of its middle.
WishPath default_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                           double press_m, double reach_m);

// The same for a handle that moves along x alone: it waits on the right of the scene, presses three
// times on what is rightmost at the middle of the scene's box, leaves and hovers.
WishPath sideways_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                            double press_m);

}  // namespace tactus::host
