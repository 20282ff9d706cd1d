// Reads a mesh file of any format that is known here. The baker calls it.
#pragma once

#include <filesystem>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns all meshes of the file, at the places that the file's nodes give them, with polygons cut
// into triangles. Nothing is merged or mended. Everything that is left out has a note. Throws
// InputError that names the file, and the line for text formats: a missing or unreadable file, an
// unknown format, another kind of file than its name says, damaged content, a vertex that is not
// finite, an index out of range, or no triangle at all.
ImportedMesh import_mesh(const std::filesystem::path& path);

}  // namespace tactus::host
