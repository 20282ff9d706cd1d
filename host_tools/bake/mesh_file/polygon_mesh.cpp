#include "host_tools/bake/mesh_file/polygon_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host_tools/bake/mesh_file/polygon_cut.h"

namespace tactus::host {
namespace {

// Adds notes on everything that has no triangle or no texture.
void note_losses(const PolygonMesh& mesh, std::size_t crossed, const std::string& file,
                 ImportedMesh& result) {
  if (mesh.lines_and_points != 0) {
    result.notes.push_back(fmt::format("{}: {} lines and points have no surface and are left out",
                                       file, mesh.lines_and_points));
  }
  if (crossed != 0) {
    result.notes.push_back(
        fmt::format("{}: {} polygons cross themselves, so that their triangles overlap; export the "
                    "mesh as triangles",
                    file, crossed));
  }
  if (!mesh.places.empty() && mesh.places.size() != mesh.corners.size()) {
    result.notes.push_back(
        fmt::format("{}: only {} of {} corners have texture coordinates, so none are used; unwrap "
                    "the whole mesh",
                    file, mesh.places.size(), mesh.corners.size()));
  }
}

}  // namespace

void PolygonMesh::add(std::span<const std::uint32_t> polygon,
                      std::span<const CornerPlace> polygon_places) {
  if (polygon.size() < 3) {
    ++lines_and_points;
    return;
  }
  corners.insert(corners.end(), polygon.begin(), polygon.end());
  ends.push_back(corners.size());
  places.insert(places.end(), polygon_places.begin(), polygon_places.end());
}

void PolygonMesh::add_with_vertices(std::span<const Vec3> polygon) {
  for (const Vec3& vertex : polygon) {
    corners.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back(vertex);
  }
  ends.push_back(corners.size());
}

ImportedMesh cut_into_triangles(PolygonMesh&& mesh, const std::string& file) {
  ImportedMesh result;
  result.triangles.reserve(mesh.corners.size() - 2 * mesh.ends.size());
  const bool textured = !mesh.places.empty() && mesh.places.size() == mesh.corners.size();
  PolygonCut cut;
  std::size_t crossed = 0;
  std::size_t begin = 0;
  for (const std::size_t end : mesh.ends) {
    const std::span polygon = std::span(mesh.corners).subspan(begin, end - begin);
    crossed += cut.make(mesh.vertices, polygon) ? 0U : 1U;
    for (const std::array<std::uint32_t, 3>& t : cut.triangles()) {
      result.triangles.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
      if (textured) {
        result.corner_places.push_back(
            {mesh.places[begin + t[0]], mesh.places[begin + t[1]], mesh.places[begin + t[2]]});
      }
    }
    begin = end;
  }
  note_losses(mesh, crossed, file, result);
  result.lines_and_points = mesh.lines_and_points;
  result.vertices = std::move(mesh.vertices);
  result.notes.insert(result.notes.begin(), mesh.notes.begin(), mesh.notes.end());
  return result;
}

void turn_inside_out(ImportedMesh& mesh) {
  for (rendering::TriangleIndices& triangle : mesh.triangles) {
    std::swap(triangle[1], triangle[2]);
  }
  for (rendering::CornerPlaces& places : mesh.corner_places) {
    std::swap(places[1], places[2]);
  }
}

}  // namespace tactus::host
