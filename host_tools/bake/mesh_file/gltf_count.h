// Counts the triangles that a glTF file declares, to hold them against those that were read.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace tactus::host {

// Returns the triangles of all nodes of the file's scene, from the JSON of a .gltf file or of the
// first chunk of a .glb file: a third of the indices of each list of triangles, or two fewer than
// the indices of a strip or fan. Nothing if the content cannot be read so.
std::optional<std::size_t> declared_gltf_triangles(std::string_view content);

}  // namespace tactus::host
