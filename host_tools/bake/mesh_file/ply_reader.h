// Reads PLY files (Stanford polygon format), text and binary. mesh_import.h calls it.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns the faces and triangle strips of a PLY file, coordinates in double, with the texture
// coordinates of vertices or corners. Elements with other lists are left out with a note. Throws
// InputError for a file that ends early, a number that is not finite, and an index out of range,
// with the line in text files.
PolygonMesh read_ply(const std::string& file, std::string_view content);

}  // namespace tactus::host
