// Draws connection graphs over their meshes: connections and corners coloured by type, nodes at the
// faces' centres.
#pragma once

#include <filesystem>

#include "host_tools/graph/graph_source.h"

namespace tactus::host {

// Draws all meshes of the source in one picture, from the front and from behind. Hidden parts are
// left out. Where connections are short, numbers and nodes are left out too. Throws InputError if
// gnuplot is missing or fails.
void draw_graph_picture(const GraphSource& source, const std::filesystem::path& picture);

}  // namespace tactus::host
