// Reads OFF files (Geomview's object file format). mesh_import.h calls it.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/mesh_file/polygon_mesh.h"

namespace tactus::host {

// Returns the mesh of an OFF text, coordinates in double. A vertex or a face has a line of its own,
// which may continue with colours and normals; comments and blank lines may stand anywhere. The
// numbers of a plain OFF file that breaks its lines otherwise are taken in their order. Throws
// InputError `file:line: ...` for a binary or four-dimensional file, a missing line, a word that is
// no number or not finite, and an index out of range.
PolygonMesh read_off(const std::string& file, std::string_view text);

}  // namespace tactus::host
