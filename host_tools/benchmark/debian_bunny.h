// Finds the benchmark's scanned mesh, the Stanford bunny.
#pragma once

#include <filesystem>
#include <optional>

namespace tactus::host {

// Extracts the bunny (75,408 triangles) from the archive of Debian's package libcgal-demo into
// `folder` and returns the file; nothing if the package is not installed.
std::optional<std::filesystem::path> extract_debian_bunny(const std::filesystem::path& folder);

}  // namespace tactus::host
