// Wish paths from a file, and those that are made from the scene for a run without a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/simulation/wish_path.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Returns the path in a CSV file with the columns t_s,x_m,y_m,z_m (world frame). Throws InputError,
// one line that names file, line and column.
WishPath read_wish_path(const std::filesystem::path& file);

// The length of a path that is made from the scene, s.
inline constexpr double kOwnPath_s = 10.0;

// Returns a path of ten seconds made from the scene's meshes: the hand waits in front of the scene
// (toward the user) while the device homes, approaches, presses on the front, strokes to both sides
// as far as the front goes on, leaves and waits. `press_m` is how far the wish lies below the
// surface; along x the path stays within `reach_m` of its middle.
WishPath default_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                           double press_m, double reach_m);

// Returns a path for a handle that moves along x alone: it waits to the right of the scene, presses
// three times on the rightmost surface at the middle of the scene's box, and leaves.
WishPath sideways_wish_path(std::span<const rendering::Object> objects, double tool_radius_m,
                            double press_m);

}  // namespace tactus::host
