#include "host_tools/bake/body/solid_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host_tools/bake/scene/open_loops.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::TriangleIndices;

// The side of a triangle along an edge, `low` and `high` its vertices, the lower number first.
struct DirectedEdge {
  std::uint32_t low;
  std::uint32_t high;
  bool upward;  // the triangle runs along it from `low` to `high`

  auto operator<=>(const DirectedEdge&) const = default;
};

void require_sound_indices(std::span<const Vec3> vertices,
                           std::span<const TriangleIndices> triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      throw InputError(fmt::format("vertex {} is not finite; repair the mesh", i));
    }
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i]) {
      if (vertex >= vertices.size()) {
        throw InputError(fmt::format("triangle {} names vertex {} of {}; repair the mesh", i,
                                     vertex, vertices.size()));
      }
    }
  }
}

// Throws InputError if two triangles have the same corners in the same turn.
void require_single_triangles(std::span<const Vec3> vertices,
                              std::span<const TriangleIndices> triangles) {
  std::vector<TriangleIndices> turned(triangles.begin(), triangles.end());
  for (TriangleIndices& t : turned) {
    std::ranges::rotate(t, std::ranges::min_element(t));
  }
  std::ranges::sort(turned);
  if (const auto twice = std::ranges::adjacent_find(turned); twice != turned.end()) {
    const Vec3& p = vertices[(*twice)[0]];
    throw InputError(
        fmt::format("a triangle is there twice, at ({:.4g}, {:.4g}, {:.4g}) m, and its solid would "
                    "count twice; "
                    "drop one of them in a mesh program",
                    p.x(), p.y(), p.z()));
  }
}

// Returns an edge of each group that is run along more often in one direction than in the other.
std::vector<DirectedEdge> unbalanced_edges(std::span<const TriangleIndices> triangles) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const TriangleIndices& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k];
      const std::uint32_t to = t[(k + 1) % 3];
      if (from != to) {
        edges.push_back({std::min(from, to), std::max(from, to), from < to});
      }
    }
  }
  std::ranges::sort(edges);
  std::vector<DirectedEdge> unbalanced;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::ptrdiff_t balance = 0;
    std::size_t end = begin;
    for (; end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high;
         ++end) {
      balance += edges[end].upward ? 1 : -1;
    }
    if (balance != 0) {
      unbalanced.push_back(edges[begin]);
    }
    begin = end;
  }
  return unbalanced;
}

// Returns the holes of the mesh; none if no edge has a single triangle.
std::vector<OpenLoop> holes_of(std::span<const Vec3> vertices,
                               std::span<const TriangleIndices> triangles) {
  std::vector<Float3> stored(vertices.size());
  std::ranges::transform(vertices, stored.begin(), rendering::to_float3);
  std::vector<TriangleIndices> distinct(triangles.begin(), triangles.end());
  std::erase_if(distinct, [](const TriangleIndices& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return find_open_loops(stored, distinct);
}

}  // namespace

void require_solid(std::span<const Vec3> vertices, std::span<const TriangleIndices> triangles) {
  require_sound_indices(vertices, triangles);
  require_single_triangles(vertices, triangles);
  const std::vector<DirectedEdge> unbalanced = unbalanced_edges(triangles);
  if (unbalanced.empty()) {
    return;
  }
  if (const std::vector<OpenLoop> holes = holes_of(vertices, triangles); !holes.empty()) {
    throw InputError(
        fmt::format("the mesh is open, so that it encloses no volume, with {}; close it in a mesh "
                    "program or by "
                    "cap_holes_mm = {:.4g}, or give its centre of mass and inertia",
                    text_of_loops(holes), cap_holes_mm_for(holes)));
  }
  const Vec3 p = 0.5 * (vertices[unbalanced.front().low] + vertices[unbalanced.front().high]);
  throw InputError(fmt::format(
      "at {} edge{} of the mesh triangles face opposite ways, or an inner wall ends; the first is "
      "at ({:.4g}, {:.4g}, {:.4g}) m; repair it in a mesh program",
      unbalanced.size(), unbalanced.size() == 1 ? "" : "s", p.x(), p.y(), p.z()));
}

}  // namespace tactus::host
