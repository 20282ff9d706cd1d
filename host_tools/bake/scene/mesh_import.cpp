#include "host_tools/bake/scene/mesh_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <string>

#include "host_tools/bake/scene/mesh_text_check.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}", path.string(), what));
}

// Returns the text with line ends replaced: an InputError is one line.
std::string one_line(std::string text) {
  std::ranges::replace_if(text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

// Returns how many triangles the polygons make if none is lost: a polygon of n corners makes n - 2.
std::size_t expected_triangles(const aiScene& scene) {
  std::size_t count = 0;
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    for (const aiFace& face : std::span(mesh->mFaces, mesh->mNumFaces)) {
      count += face.mNumIndices > 2 ? face.mNumIndices - 2 : 0;
    }
  }
  return count;
}

// Returns how many faces are triangles.
std::size_t found_triangles(const aiScene& scene) {
  std::size_t count = 0;
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    count += static_cast<std::size_t>(
        std::ranges::count(std::span(mesh->mFaces, mesh->mNumFaces), 3U, &aiFace::mNumIndices));
  }
  return count;
}

// Reads, validates and triangulates in three steps, so that the message can tell which step failed.
// Assimp drops a polygon that it cannot cut without a word; the count of triangles shows it.
const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& path) {
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene != nullptr) {
    scene = importer.ApplyPostProcessing(aiProcess_ValidateDataStructure);
  }
  if (scene == nullptr) {
    fail(path, fmt::format("Assimp cannot read this mesh: {}; repair or export it again",
                           one_line(importer.GetErrorString())));
  }
  const std::size_t expected = expected_triangles(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || found_triangles(*scene) != expected) {
    fail(path, "has a polygon that cannot be cut into triangles; export the mesh as triangles");
  }
  return *scene;
}

// Returns a vertex under a node's transform, in double.
Vec3 transformed(const aiMatrix4x4t<double>& transform, const aiVector3D& v) {
  const aiVector3t<double> p =
      transform * aiVector3t<double>(static_cast<double>(v.x), static_cast<double>(v.y),
                                     static_cast<double>(v.z));
  return {p.x, p.y, p.z};
}

// Collects the meshes of all nodes into one.
class Collector {
 public:
  Collector(const aiScene& scene, const std::filesystem::path& path) : scene_(scene), path_(path) {}

  // Adds a node and its children; transforms multiply from the root downwards, in double.
  void add_node(const aiNode& node, const aiMatrix4x4t<double>& parent) {
    const aiMatrix4x4t<double> transform =
        parent * static_cast<aiMatrix4x4t<double>>(node.mTransformation);
    for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
      add_mesh(*scene_.mMeshes[index], transform);
    }
    for (const aiNode* child : std::span(node.mChildren, node.mNumChildren)) {
      add_node(*child, transform);
    }
  }

  // Returns the mesh. Texture coordinates for only some of the triangles are dropped.
  ImportedMesh take() {
    if (result_.corner_places.size() != result_.triangles.size()) {
      result_.corner_places.clear();
    }
    return std::move(result_);
  }

 private:
  // Appends the mesh's vertices and faces. Throws InputError at a number that is not finite.
  void add_mesh(const aiMesh& mesh, const aiMatrix4x4t<double>& transform) {
    const auto first = static_cast<std::uint32_t>(result_.vertices.size());
    for (const aiVector3D& v : std::span(mesh.mVertices, mesh.mNumVertices)) {
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        fail(path_, fmt::format("vertex {} is not finite ({}, {}, {}); repair or export the mesh "
                                "again",
                                result_.vertices.size(), v.x, v.y, v.z));
      }
      result_.vertices.push_back(transformed(transform, v));
    }
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      add_face(face, mesh, first);
    }
  }

  // Appends a triangle; other faces, which are lines and points by now, are counted.
  void add_face(const aiFace& face, const aiMesh& mesh, std::uint32_t first) {
    if (face.mNumIndices != 3) {
      ++result_.lines_and_points;
      return;
    }
    rendering::TriangleIndices triangle{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) {
        fail(path_, fmt::format("face {} names vertex {} of {}; repair or export the mesh again",
                                result_.triangles.size(), face.mIndices[k], mesh.mNumVertices));
      }
      triangle[k] = first + face.mIndices[k];
    }
    result_.triangles.push_back(triangle);
    add_places(face, mesh);
  }

  // Appends the texture coordinates of a triangle, if the mesh has two of them for each corner.
  void add_places(const aiFace& face, const aiMesh& mesh) {
    constexpr unsigned kPlane = 2;
    if (!mesh.HasTextureCoords(0) || mesh.mNumUVComponents[0] < kPlane) {
      return;
    }
    rendering::CornerPlaces places{};
    for (unsigned k = 0; k < 3; ++k) {
      const aiVector3D& uv = mesh.mTextureCoords[0][face.mIndices[k]];
      // A comparison with NaN is false, so NaN is refused too.
      const bool in_range = std::abs(uv.x) <= rendering::kMostTexturePlace &&
                            std::abs(uv.y) <= rendering::kMostTexturePlace;
      if (!in_range) {
        fail(path_, fmt::format("a texture coordinate of face {} is ({}, {}); repair or export the "
                                "mesh again",
                                result_.triangles.size() - 1, uv.x, uv.y));
      }
      places[k] = {uv.x, uv.y};
    }
    result_.corner_places.push_back(places);
  }

  const aiScene& scene_;
  const std::filesystem::path& path_;
  ImportedMesh result_;
};

// Throws InputError if there is no such file or it is empty.
void require_readable(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    fail(path, "there is no such mesh file; check the path");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    fail(path, "is not a file; name a mesh file");
  }
  if (std::filesystem::file_size(path, error) == 0) {
    fail(path, "the mesh file is empty; export it again");
  }
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path) {
  require_readable(path);
  check_mesh_text(path);
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path);
  Collector collector(scene, path);
  collector.add_node(*scene.mRootNode, aiMatrix4x4t<double>());
  ImportedMesh mesh = collector.take();
  if (mesh.triangles.empty()) {
    fail(path, "has no triangle; export a surface mesh");
  }
  return mesh;
}

}  // namespace tactus::host
