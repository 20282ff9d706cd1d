#include "host_tools/mesh/icosphere.h"

#include <algorithm>
#include <numbers>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tactus::host {
namespace {

using rendering::TriangleIndices;

// A mesh on the unit sphere, in double precision until the last step.
struct UnitMesh {
  std::vector<Vec3> vertices;
  std::vector<TriangleIndices> triangles;
};

// The twelve vertices are the corners of three golden rectangles in the coordinate planes,
// normalised.
UnitMesh icosahedron() {
  constexpr double g = std::numbers::phi;
  UnitMesh mesh{.vertices = {{-1, g, 0},
                             {1, g, 0},
                             {-1, -g, 0},
                             {1, -g, 0},
                             {0, -1, g},
                             {0, 1, g},
                             {0, -1, -g},
                             {0, 1, -g},
                             {g, 0, -1},
                             {g, 0, 1},
                             {-g, 0, -1},
                             {-g, 0, 1}},
                .triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                              {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                              {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                              {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  for (Vec3& v : mesh.vertices) {
    v.normalize();
  }
  return mesh;
}

// Replaces every triangle by four. The middle of an edge is made once for both of its triangles, so
// that the mesh stays closed.
void subdivide(UnitMesh& mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  middles.reserve(mesh.triangles.size() * 2);
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    // Both triangles of an edge name it in opposite directions; the sorted pair is the same.
    const std::uint64_t edge = (std::uint64_t{low} << 32U) | high;
    const auto [place, fresh] =
        middles.try_emplace(edge, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (fresh) {
      mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    }
    return place->second;
  };
  std::vector<TriangleIndices> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

}  // namespace

TriangleMesh icosphere(double radius_m, int subdivisions) {
  UnitMesh unit = icosahedron();
  for (int level = 0; level < subdivisions; ++level) {
    subdivide(unit);
  }
  TriangleMesh mesh{.triangles = std::move(unit.triangles)};
  mesh.vertices.reserve(unit.vertices.size());
  for (const Vec3& v : unit.vertices) {
    const Vec3 p = radius_m * v;
    mesh.vertices.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  return mesh;
}

}  // namespace tactus::host
