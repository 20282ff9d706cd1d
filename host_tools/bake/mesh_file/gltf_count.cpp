#include "host_tools/bake/mesh_file/gltf_count.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace tactus::host {
namespace {

using nlohmann::json;

// The modes of a primitive that make triangles (glTF 2.0, 3.7.2.1).
constexpr int kGltfTriangles = 4;
constexpr int kGltfStrip = 5;
constexpr int kGltfFan = 6;

// Returns the JSON: the content itself, or that of the first chunk behind 20 bytes of binary head.
std::string_view gltf_json(std::string_view content) {
  constexpr std::size_t kGltfHead = 20;
  constexpr std::size_t kLengthPlace = 12;
  if (!content.starts_with("glTF") || content.size() < kGltfHead) {
    return content;
  }
  std::size_t length = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    length |= std::size_t{static_cast<unsigned char>(content[kLengthPlace + k])} << (8 * k);
  }
  return content.substr(kGltfHead, length);
}

// Returns the triangles of one primitive.
std::size_t triangles_of(const json& file, const json& primitive) {
  const json& accessor = primitive.contains("indices") ? primitive.at("indices")
                                                       : primitive.at("attributes").at("POSITION");
  const std::size_t count =
      file.at("accessors").at(accessor.get<std::size_t>()).at("count").get<std::size_t>();
  const int mode = primitive.contains("mode") ? primitive.at("mode").get<int>() : kGltfTriangles;
  if (mode == kGltfTriangles) {
    return count / 3;
  }
  const bool is_row = mode == kGltfStrip || mode == kGltfFan;
  return is_row && count > 2 ? count - 2 : 0;
}

// Returns the triangles of a node and its children. No node lies deeper than `depth`, since nodes
// form a tree.
std::size_t triangles_below(const json& file, std::size_t node_index, std::size_t depth) {
  const json& node = file.at("nodes").at(node_index);
  std::size_t count = 0;
  if (node.contains("mesh")) {
    for (const json& primitive :
         file.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")) {
      count += triangles_of(file, primitive);
    }
  }
  if (node.contains("children") && depth > 0) {
    for (const json& child : node.at("children")) {
      count += triangles_below(file, child.get<std::size_t>(), depth - 1);
    }
  }
  return count;
}

}  // namespace

std::optional<std::size_t> declared_gltf_triangles(std::string_view content) {
  try {
    const json file = json::parse(gltf_json(content));
    const std::size_t shown = file.contains("scene") ? file.at("scene").get<std::size_t>() : 0;
    const json& scene = file.at("scenes").at(shown);
    std::size_t count = 0;
    for (const json& root : scene.at("nodes")) {
      count += triangles_below(file, root.get<std::size_t>(), file.at("nodes").size());
    }
    return count;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace tactus::host
