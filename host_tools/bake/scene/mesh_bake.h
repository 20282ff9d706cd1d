// Makes the controller's form of a mesh from triangles, in memory: for baking files, and for tests
// and benchmarks that make their own meshes.
#pragma once

#include <span>
#include <vector>

#include "host_tools/bake/scene/mesh_cleanup.h"
#include "rendering/objects/object.h"
#include "rendering/scene/mesh_check.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

struct MeshBakeOptions {
  double weld_m = 0.0;  // 0: only exactly equal positions are merged
};

// World frame, metres. Triangles stand in the order of the hierarchy's leaves.
struct BakedMesh {
  std::vector<rendering::Float3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
  std::vector<rendering::TriangleNeighbours> neighbours;
  std::vector<rendering::Float3> vertex_normals;
  std::vector<rendering::BvhNode> nodes;
  std::vector<rendering::CornerPlaces> corner_places;    // one a triangle, or none
  std::vector<rendering::CornerNormals> corner_normals;  // one a triangle once it is shaded
  rendering::BakeCounters counters;

  // Valid as long as this mesh lives and keeps its vectors.
  [[nodiscard]] rendering::MeshView view() const {
    return {.vertices = vertices, .triangles = triangles, .nodes = nodes};
  }
  [[nodiscard]] rendering::BakedMeshView baked_view() const {
    return {.mesh = view(), .neighbours = neighbours, .vertex_normals = vertex_normals};
  }
};

// Welds, drops degenerate triangles, builds the hierarchy, orders, finds neighbours and normals.
// The result depends on the input alone. Throws InputError, without a file name, on a vertex that
// is not finite, an index out of range, and when no triangle is left.
BakedMesh bake_mesh(TriangleMesh mesh, const MeshBakeOptions& options = {});
BakedMesh bake_mesh(std::span<const rendering::Float3> vertices,
                    std::span<const rendering::TriangleIndices> triangles,
                    const MeshBakeOptions& options = {});

}  // namespace tactus::host
