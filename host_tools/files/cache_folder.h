// The folder in which the tools keep what they have fetched once.
#pragma once

#include <filesystem>

namespace tactus::host {

// Returns tactus in $XDG_CACHE_HOME, or in ~/.cache; an empty path if neither is known. Call it
// from one thread.
std::filesystem::path user_cache_folder();

}  // namespace tactus::host
