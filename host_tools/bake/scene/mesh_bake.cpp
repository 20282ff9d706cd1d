#include "host_tools/bake/scene/mesh_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_tools/bake/scene/mesh_topology.h"
#include "host_tools/input_error.h"
#include "host_tools/mesh/hierarchy.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::TriangleIndices;

// Throws InputError if the mesh cannot be baked at all.
void require_sound(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Float3& v = mesh.vertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw InputError(fmt::format("vertex {} is not finite; repair the mesh", i));
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex >= mesh.vertices.size()) {
        throw InputError(fmt::format("triangle {} names vertex {} of {}; repair the mesh", i,
                                     vertex, mesh.vertices.size()));
      }
    }
  }
}

// Returns the values in that order.
template <class T>
std::vector<T> reordered(const std::vector<T>& values, std::span<const std::uint32_t> order) {
  std::vector<T> result(order.size());
  std::ranges::transform(order, result.begin(), [&](std::uint32_t i) { return values[i]; });
  return result;
}

}  // namespace

BakedMesh bake_mesh(TriangleMesh mesh, const MeshBakeOptions& options) {
  require_sound(mesh);
  BakedMesh baked;
  baked.counters.welded_vertices = weld(mesh, options.weld_m);
  baked.counters.degenerate_triangles = drop_degenerate(mesh);
  if (mesh.triangles.empty()) {
    throw InputError(
        fmt::format("no triangle with an area is left ({} dropped); check the mesh and its scale",
                    baked.counters.degenerate_triangles));
  }
  baked.counters.welded_vertices += weld_rims(mesh);
  if (options.cap_holes_m > 0.0) {
    baked.caps = cap_holes(mesh, options.cap_holes_m);
  }
  Hierarchy hierarchy = build_hierarchy(mesh.vertices, mesh.triangles);
  mesh.triangles = reordered(mesh.triangles, hierarchy.order);
  if (!mesh.corner_places.empty()) {
    baked.corner_places = reordered(mesh.corner_places, hierarchy.order);
  }
  // After the triangles have their order: the vertices of a leaf then lie side by side in memory.
  order_vertices_by_use(mesh);
  Topology topology = find_topology(mesh.triangles, mesh.vertices.size());
  baked.counters.open_edges = topology.open_edges;
  baked.counters.non_manifold_edges = topology.non_manifold_edges;
  baked.counters.inconsistent_edges = topology.inconsistent_edges;
  baked.vertex_normals = angle_weighted_normals(mesh.vertices, mesh.triangles);
  baked.vertices = std::move(mesh.vertices);
  baked.triangles = std::move(mesh.triangles);
  baked.neighbours = std::move(topology.neighbours);
  baked.nodes = std::move(hierarchy.nodes);
  return baked;
}

BakedMesh bake_mesh(std::span<const Float3> vertices, std::span<const TriangleIndices> triangles,
                    const MeshBakeOptions& options) {
  return bake_mesh(TriangleMesh{.vertices = {vertices.begin(), vertices.end()},
                                .triangles = {triangles.begin(), triangles.end()}},
                   options);
}

}  // namespace tactus::host
