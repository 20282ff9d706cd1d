#include "host_tools/bake/mesh_file/mesh_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "host_tools/bake/mesh_file/assimp_reader.h"
#include "host_tools/bake/mesh_file/file_kind.h"
#include "host_tools/bake/mesh_file/gltf_count.h"
#include "host_tools/bake/mesh_file/obj_reader.h"
#include "host_tools/bake/mesh_file/off_reader.h"
#include "host_tools/bake/mesh_file/ply_reader.h"
#include "host_tools/bake/mesh_file/stl_reader.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/foreign_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Throws InputError if there is no such file or it is empty.
void require_readable(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}", path.string(), what));
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    refuse("there is no such mesh file; check the path");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    refuse("is not a file; name a mesh file");
  }
  if (std::filesystem::file_size(path, error) == 0) {
    refuse("the mesh file is empty; export it again");
  }
}

// Gives the text lines that end as the readers expect: a carriage return alone, as of old Macs,
// becomes a line end.
void mend_line_ends(std::string& text) {
  if (text.find('\n') == std::string::npos) {
    std::ranges::replace(text, '\r', '\n');
  }
}

PolygonMesh read_by_extension(const std::filesystem::path& path, std::string content) {
  const std::string extension = lower_extension(path);
  if (extension == ".off" || extension == ".obj") {
    mend_line_ends(content);
  }
  const std::string_view text = without_byte_order_mark(content);
  if (extension == ".off") {
    return read_off(path.string(), text);
  }
  if (extension == ".obj") {
    return read_obj(path.string(), text);
  }
  if (extension == ".ply") {
    return read_ply(path.string(), text);
  }
  if (extension == ".stl") {
    return read_stl(path.string(), text);
  }
  return read_with_assimp(path);
}

// Adds a note if a glTF file declares another number of triangles than was read.
void compare_with_declared(const std::filesystem::path& path, std::string_view content,
                           ImportedMesh& mesh) {
  const std::string extension = lower_extension(path);
  if (extension != ".gltf" && extension != ".glb") {
    return;
  }
  const std::optional<std::size_t> declared = declared_gltf_triangles(content);
  if (declared && *declared != mesh.triangles.size()) {
    mesh.notes.push_back(
        fmt::format("{}: the file declares {} triangles, of which {} could be read; repair it, or "
                    "export it without "
                    "compression and extensions",
                    path.string(), *declared, mesh.triangles.size()));
  }
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path) {
  require_readable(path);
  const std::string content = read_file(path);
  refuse_foreign_mesh(path, content);
  ImportedMesh mesh = cut_into_triangles(read_by_extension(path, content), path.string());
  if (mesh.triangles.empty()) {
    throw InputError(
        fmt::format("{}: has no triangle{}; export a surface mesh", path.string(),
                    mesh.notes.empty() ? "" : fmt::format(" ({})", mesh.notes.front())));
  }
  compare_with_declared(path, content, mesh);
  return mesh;
}

}  // namespace tactus::host
