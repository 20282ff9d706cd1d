#include "host_tools/bake/mesh_file/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "host_tools/files/foreign_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::string_view kExportFromCad =
    "is CAD data, which has no triangles; export it as STL or OBJ from a CAD program";
constexpr std::string_view kConvert =
    "is a data set for simulations, which is not read; convert it to PLY or STL";

constexpr std::array kMeshKinds{
    FileBeginning{"iso-10303-21", ".ifc", kExportFromCad},
    FileBeginning{"dbrep_drawableshape", "", kExportFromCad},
    FileBeginning{"cascade topology", "", kExportFromCad},
    FileBeginning{"# vtk datafile", "", kConvert},
    FileBeginning{"<vtkfile", "", kConvert},
    FileBeginning{"meshversionformatted", "", kConvert},
    FileBeginning{"$meshformat", "", kConvert},
    FileBeginning{"# .pcd", "", "is a cloud of points without triangles; make a mesh of it first"},
    FileBeginning{"ply\n", ".ply", "is a PLY file with another ending; rename it to .ply"},
    FileBeginning{"ply\r", ".ply", "is a PLY file with another ending; rename it to .ply"},
    FileBeginning{"off\n", ".off", "is an OFF file with another ending; rename it to .off"},
    FileBeginning{"off\r", ".off", "is an OFF file with another ending; rename it to .off"},
    FileBeginning{"gltf\x02", ".glb .vrm",
                  "is a binary glTF file with another ending; rename it to .glb"},
    FileBeginning{"kaydara fbx binary", ".fbx",
                  "is an FBX file with another ending; rename it to .fbx"},
    FileBeginning{"#vrml", ".wrl .x3dv", "is a VRML file; convert it to PLY or STL"},
};

// IGES has lines of 80 characters, and in column 73 of the first ones an S.
bool is_iges(std::string_view content) {
  constexpr std::size_t kColumn = 72;
  constexpr std::string_view kMark = "S      1";
  return content.size() > kColumn && content.substr(kColumn, kMark.size()) == kMark;
}

// Returns what is wrong with the content; empty if nothing is.
std::string_view complaint_about(std::string_view content, std::string_view extension) {
  for (const FileBeginning& kind : kMeshKinds) {
    if (begins_as(content, extension, kind)) {
      return kind.message;
    }
  }
  return is_iges(content) ? kExportFromCad : foreign_content(content, extension);
}

}  // namespace

void refuse_foreign_mesh(const std::filesystem::path& path, std::string_view content) {
  const std::string_view complaint = complaint_about(content, lower_extension(path));
  if (!complaint.empty()) {
    throw InputError(fmt::format("{}: this file {}", path.string(), complaint));
  }
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace tactus::host
