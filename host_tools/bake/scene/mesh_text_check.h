// Checks text meshes before Assimp reads them, for errors that Assimp repairs silently or reports
// without a place. In an OFF file, for example, an index out of range becomes the last vertex and a
// face with ten corners disappears; missing PLY vertices repeat the last one.
#pragma once

#include <filesystem>

namespace tactus::host {

// Checks OFF, OBJ, ASCII PLY and ASCII STL, chosen by the file's extension; every other file
// passes. Throws InputError `file:line: ...` at the first word that is no number or not finite,
// index out of range, face of a wrong size, or missing line.
void check_mesh_text(const std::filesystem::path& path);

}  // namespace tactus::host
