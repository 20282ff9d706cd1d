// Turns triangles into the form in which the controller touches them, in memory. The baker uses it
// for files; tests and benchmarks use it for meshes that they make themselves.
#pragma once

#include <span>
#include <vector>

#include "host_tools/bake/scene/hole_caps.h"
#include "host_tools/bake/scene/mesh_cleanup.h"
#include "rendering/objects/object.h"
#include "rendering/scene/mesh_check.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// How a mesh is baked.
struct MeshBakeOptions {
  // Vertices closer than this become one; 0 merges exactly equal positions only.
  double weld_m = 0.0;
  // Holes of at most this size are closed (hole_caps.h), m; 0 closes none.
  double cap_holes_m = 0.0;
};

// A mesh in the world frame, m, with its triangles in the order of the hierarchy's leaves.
struct BakedMesh {
  std::vector<rendering::Float3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
  // For each triangle the three triangles across its edges.
  std::vector<rendering::TriangleNeighbours> neighbours;
  // Angle-weighted unit normals; zero where faces cancel out.
  std::vector<rendering::Float3> vertex_normals;
  // The bounding-volume hierarchy, root first.
  std::vector<rendering::BvhNode> nodes;
  // The texture places of each triangle's corners; empty if the mesh has none.
  std::vector<rendering::CornerPlaces> corner_places;
  // The shading normals of each triangle's corners; empty unless the object is shaded.
  std::vector<rendering::CornerNormals> corner_normals;
  // The numbers of welded vertices, dropped triangles and faulty edges.
  rendering::BakeCounters counters;
  // The holes that were closed.
  HoleCaps caps;

  // Return views that are valid as long as this mesh lives and its vectors are unchanged.
  [[nodiscard]] rendering::MeshView view() const {
    return {.vertices = vertices, .triangles = triangles, .nodes = nodes};
  }
  [[nodiscard]] rendering::BakedMeshView baked_view() const {
    return {.mesh = view(), .neighbours = neighbours, .vertex_normals = vertex_normals};
  }
};

// Welds vertices, drops triangles without area, closes small holes, builds the hierarchy, orders
// the arrays by it, and finds neighbours and normals. The result depends on the input alone. Throws
// InputError, without a file name, for a vertex that is not finite, an index out of range, a hole
// that no triangles close, and if no triangle is left.
BakedMesh bake_mesh(TriangleMesh mesh, const MeshBakeOptions& options = {});
BakedMesh bake_mesh(std::span<const rendering::Float3> vertices,
                    std::span<const rendering::TriangleIndices> triangles,
                    const MeshBakeOptions& options = {});

}  // namespace tactus::host
