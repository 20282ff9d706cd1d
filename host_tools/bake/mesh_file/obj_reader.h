// Reads OBJ files (Wavefront). mesh_import.h calls it.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns the polygons of an OBJ text with their texture coordinates, vertices in double. All
// objects and groups become one mesh. Curves and free-form surfaces are left out with a note.
// Throws InputError `file:line: ...` for a word that is no number or not finite, an index out of
// range, and a face without corners.
PolygonMesh read_obj(const std::string& file, std::string_view text);

}  // namespace tactus::host
