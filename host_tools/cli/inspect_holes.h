// The holes of a scene's meshes, as `tactus inspect` lists and draws them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/bake/scene/open_loops.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Returns the holes of an object, the largest first; none of one that is not a mesh.
std::vector<OpenLoop> holes_of(const rendering::SceneImage& image, std::size_t index);

// Draws the scene with the holes of all its meshes. `name` begins the title. Throws InputError if
// gnuplot is missing or fails.
void draw_holes(const rendering::SceneImage& image, const std::string& name,
                const std::filesystem::path& picture);

}  // namespace tactus::host
