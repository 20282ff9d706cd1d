#include "host_tools/graph/graph_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "host_tools/bake/mesh_file/mesh_import.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/mesh_cleanup.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns true if the file begins as a baked scene does, or is named like one.
bool is_scene_image(const std::filesystem::path& file) {
  constexpr std::string_view kSceneStart = "TACTUS\r\n";
  std::array<char, kSceneStart.size()> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == kSceneStart ||
         file.extension() == ".tactus";
}

void read_scene(const std::filesystem::path& file, GraphSource& source) {
  const MappedScene scene(file);
  for (std::uint32_t i = 0; i < scene.image().objects().size(); ++i) {
    const rendering::Object& object = scene.image().objects()[i];
    const std::string name(scene.image().object_name(i));
    if (object.surface != rendering::SurfaceKind::mesh) {
      source.notes.push_back(fmt::format(
          "object {}, {}: a {}, which has no graph", i, name,
          object.surface == rendering::SurfaceKind::primitive ? "primitive" : "formula"));
      continue;
    }
    const rendering::MeshView& mesh = object.mesh;
    source.meshes.push_back({.name = name,
                             .object = i,
                             .mesh = {.vertices = {mesh.vertices.begin(), mesh.vertices.end()},
                                      .triangles = {mesh.triangles.begin(), mesh.triangles.end()},
                                      .corner_places = {}},
                             .graph = connection_graph(mesh.vertices, mesh.triangles)});
  }
}

// Moves a mesh that is far from the origin beside it: float would round the coordinates of a map so
// much that vertices coincide.
void move_near(ImportedMesh& mesh, GraphSource& source) {
  constexpr double kFar = 100.0;  // sizes of the mesh; a float then still has five digits of it
  Vec3 lower = mesh.vertices.front();
  Vec3 upper = lower;
  for (const Vec3& p : mesh.vertices) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double size = (upper - lower).maxCoeff();
  if (lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff() <= kFar * size) {
    return;
  }
  for (Vec3& p : mesh.vertices) {
    p -= lower;
  }
  source.notes.push_back(
      fmt::format("{}: it is far from the origin; positions are from ({:.9g}, {:.9g}, {:.9g})",
                  source.file, lower.x(), lower.y(), lower.z()));
}

void read_mesh(const std::filesystem::path& file, GraphSource& source) {
  ImportedMesh imported = import_mesh(file);
  source.notes = std::move(imported.notes);
  move_near(imported, source);
  GraphedMesh& graphed = source.meshes.emplace_back();
  graphed.name = file.stem().string();
  graphed.mesh.triangles = std::move(imported.triangles);
  std::ranges::transform(imported.vertices, std::back_inserter(graphed.mesh.vertices),
                         [](const Vec3& p) { return rendering::to_float3(p); });
  weld(graphed.mesh, 0.0);
  const std::uint32_t dropped = drop_degenerate(graphed.mesh);
  if (dropped != 0) {
    source.notes.push_back(fmt::format("{}: {} triangle{} without area left out", file.string(),
                                       dropped, dropped == 1 ? "" : "s"));
  }
  if (graphed.mesh.triangles.empty()) {
    throw InputError(fmt::format("{}: no triangle has an area", file.string()));
  }
  graphed.graph = connection_graph(graphed.mesh.vertices, graphed.mesh.triangles);
}

}  // namespace

GraphSource read_graphs(const std::filesystem::path& file) {
  GraphSource source{
      .file = file.string(), .is_scene = is_scene_image(file), .meshes = {}, .notes = {}};
  if (source.is_scene) {
    read_scene(file, source);
    if (source.meshes.empty()) {
      throw InputError(fmt::format("{}: it has no mesh, and only meshes have a connection graph",
                                   file.string()));
    }
  } else {
    read_mesh(file, source);
  }
  return source;
}

std::vector<GraphedMesh> read_scene_graphs(const std::filesystem::path& scene) {
  GraphSource source;
  read_scene(scene, source);
  return std::move(source.meshes);
}

}  // namespace tactus::host
