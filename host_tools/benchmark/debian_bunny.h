// Finds the benchmark's real mesh, the Stanford bunny of Debian's package.
#pragma once

#include <filesystem>
#include <optional>

namespace tactus::host {

// The Stanford bunny (75,408 triangles) of Debian's package libcgal-demo, taken out of the
// package's archive into `folder`; nothing if the package is not installed.
std::optional<std::filesystem::path> extract_debian_bunny(const std::filesystem::path& folder);

}  // namespace tactus::host
