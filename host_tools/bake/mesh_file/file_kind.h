// Recognises files that are no mesh, or another mesh than their name says, by how they begin.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tactus::host {

// Throws InputError that says what the file is and what to do, for content that a mesh file of this
// name never has: whatever foreign_content() recognises, CAD data, data of simulations, or a mesh
// of another format.
void refuse_foreign_mesh(const std::filesystem::path& path, std::string_view content);

// Returns the extension in lower case, with its point.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace tactus::host
