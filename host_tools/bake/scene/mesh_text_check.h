// Looks through text meshes before Assimp reads them, for what Assimp mends in silence or reports
// without a place: an index out of range in an OFF file becomes the last vertex there, a face of
// ten corners disappears, missing PLY vertices repeat the last one.
#pragma once

#include <filesystem>

namespace tactus::host {

// OFF, OBJ, ASCII PLY and ASCII STL, by the file's extension; every other file passes. Throws
// InputError `file:line: ...` at the first number that is none or not finite, index out of range,
// face of a wrong size, or line that is missing.
void check_mesh_text(const std::filesystem::path& path);

}  // namespace tactus::host
