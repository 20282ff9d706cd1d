#include "host_tools/bake/mesh_file/assimp_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

[[noreturn]] void fail_in_mesh(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}", path.string(), what));
}

// Returns the text with line ends replaced: an InputError is one line.
std::string one_line(std::string text) {
  std::ranges::replace_if(text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& path) {
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene != nullptr) {
    scene = importer.ApplyPostProcessing(aiProcess_ValidateDataStructure);
  }
  if (scene == nullptr) {
    fail_in_mesh(path, fmt::format("Assimp cannot read this mesh: {}; repair or export it again",
                                   one_line(importer.GetErrorString())));
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

  PolygonMesh take() {
    note_coarse_coordinates();
    return std::move(result_);
  }

 private:
  // Appends the mesh's vertices and faces. Throws InputError at a number that is not finite.
  void add_mesh(const aiMesh& mesh, const aiMatrix4x4t<double>& transform) {
    const auto first = static_cast<std::uint32_t>(result_.vertices.size());
    const bool mirrors = transform.Determinant() < 0.0;
    for (const aiVector3D& v : std::span(mesh.mVertices, mesh.mNumVertices)) {
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        fail_in_mesh(path_,
                     fmt::format("vertex {} is not finite ({}, {}, {}); repair or export the "
                                 "mesh again",
                                 result_.vertices.size(), v.x, v.y, v.z));
      }
      file_box_.extend(
          Vec3(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)));
      result_.vertices.push_back(transformed(transform, v));
    }
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      add_face(face, mesh, first, mirrors);
    }
  }

  void add_face(const aiFace& face, const aiMesh& mesh, std::uint32_t first, bool mirrors) {
    corners_.clear();
    places_.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = face.mIndices[k];
      if (index >= mesh.mNumVertices) {
        fail_in_mesh(path_,
                     fmt::format("face {} names vertex {} of {}; repair or export the mesh again",
                                 result_.ends.size(), index, mesh.mNumVertices));
      }
      corners_.push_back(first + index);
      add_place(index, mesh);
    }
    if (mirrors) {
      std::ranges::reverse(corners_);
      std::ranges::reverse(places_);
    }
    result_.add(corners_, places_);
  }

  // Appends the texture coordinates of a vertex, if the mesh has two of them for each.
  void add_place(unsigned index, const aiMesh& mesh) {
    constexpr unsigned kPlane = 2;
    if (!mesh.HasTextureCoords(0) || mesh.mNumUVComponents[0] < kPlane) {
      return;
    }
    const aiVector3D& uv = mesh.mTextureCoords[0][index];
    // A comparison with NaN is false, so NaN is refused too.
    const bool in_range = std::abs(uv.x) <= rendering::kMostTexturePlace &&
                          std::abs(uv.y) <= rendering::kMostTexturePlace;
    if (!in_range) {
      fail_in_mesh(path_,
                   fmt::format("a texture coordinate of face {} is ({}, {}); repair or export "
                               "the mesh again",
                               result_.ends.size(), uv.x, uv.y));
    }
    places_.push_back({uv.x, uv.y});
  }

  // Adds a note if the floats of the file's coordinates are farther apart than a hundred-thousandth
  // of the mesh.
  void note_coarse_coordinates() {
    constexpr double kShareOfSize = 1e-5;
    if (file_box_.isEmpty()) {
      return;
    }
    const double farthest =
        std::max(file_box_.min().cwiseAbs().maxCoeff(), file_box_.max().cwiseAbs().maxCoeff());
    const double step = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
    const double size = file_box_.sizes().maxCoeff();
    if (step > kShareOfSize * size) {
      result_.notes.push_back(fmt::format(
          "{}: the mesh of size {:.3g} lies {:.6g} from its origin, where its coordinates are read "
          "in steps of {:.2g}; move it to the origin, or save it as OBJ, PLY or OFF",
          path_.string(), size, farthest, step));
    }
  }

  const aiScene& scene_;
  const std::filesystem::path& path_;
  PolygonMesh result_;
  // The box of the coordinates as the file has them.
  Eigen::AlignedBox3d file_box_;
  std::vector<std::uint32_t> corners_;
  std::vector<CornerPlace> places_;
};

}  // namespace

PolygonMesh read_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path);
  Collector collector(scene, path);
  collector.add_node(*scene.mRootNode, aiMatrix4x4t<double>());
  return collector.take();
}

}  // namespace tactus::host
