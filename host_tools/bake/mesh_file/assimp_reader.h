// Reads the mesh formats that have no reader of their own here, through Assimp. mesh_import.h calls
// it.
#pragma once

#include <filesystem>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns all meshes of the file, at the places that the file's nodes give them. A node that
// mirrors has its polygons wound the other way, so that they face outwards again (glTF 2.0, 3.7.4).
// Assimp reads coordinates as floats; a note says so where that is coarse for the mesh. Throws
// InputError that names the file: an unknown format, damaged content, a vertex that is not finite,
// and an index out of range.
PolygonMesh read_with_assimp(const std::filesystem::path& path);

}  // namespace tactus::host
