#include "host_tools/bake/scene/mesh_topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::kNoNeighbour;
using rendering::to_float3;
using rendering::TriangleIndices;

// One triangle's side of an edge; the table keeps it under the smaller of its two vertices.
struct HalfEdge {
  std::uint32_t larger_vertex;
  std::uint32_t triangle;
  std::uint8_t edge;
  // True if the triangle runs along it from the smaller vertex to the larger.
  bool upward;
};

// All half edges, sorted by their edge: a counting sort by the smaller vertex, then a sort by the
// larger one among the few that share it. That is faster than a hash map, and its order depends on
// the input alone.
class EdgeTable {
 public:
  EdgeTable(std::span<const TriangleIndices> triangles, std::size_t vertex_count)
      : begin_(vertex_count + 1, 0), half_edges_(3 * triangles.size()) {
    for_each_edge(triangles, [&](std::uint32_t from, std::uint32_t to, auto, auto) {
      ++begin_[std::min(from, to) + 1];
    });
    for (std::size_t v = 0; v < vertex_count; ++v) {
      begin_[v + 1] += begin_[v];
    }
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_edge(triangles, [&](std::uint32_t from, std::uint32_t to, auto triangle, auto edge) {
      half_edges_[next[std::min(from, to)]++] = {std::max(from, to), triangle, edge, from < to};
    });
    for (std::size_t v = 0; v < vertex_count; ++v) {
      std::ranges::sort(at(v), [](const HalfEdge& a, const HalfEdge& b) {
        return std::pair(a.larger_vertex, a.triangle) < std::pair(b.larger_vertex, b.triangle);
      });
    }
  }

  // Returns the half edges whose smaller vertex is `vertex`; equal edges stand together.
  std::span<HalfEdge> at(std::size_t vertex) {
    return std::span(half_edges_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  template <class Action>
  static void for_each_edge(std::span<const TriangleIndices> triangles, Action action) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        action(triangles[t][k], triangles[t][(k + 1U) % 3U], t, k);
      }
    }
  }

  // The index in half_edges_ of each vertex's first half edge, with one more entry at the end.
  std::vector<std::uint32_t> begin_;
  std::vector<HalfEdge> half_edges_;
};

// Counts or connects one edge; `sharing` holds all of its half edges.
void take_edge(Topology& topology, std::span<const HalfEdge> sharing) {
  if (sharing.size() == 1) {
    ++topology.open_edges;
    return;
  }
  if (sharing.size() > 2) {
    ++topology.non_manifold_edges;
    return;
  }
  const HalfEdge& a = sharing[0];
  const HalfEdge& b = sharing[1];
  topology.neighbours[a.triangle][a.edge] = b.triangle;
  topology.neighbours[b.triangle][b.edge] = a.triangle;
  topology.inconsistent_edges += a.upward == b.upward ? 1 : 0;
}

// Returns the interior angle between two edges of a corner, rad. atan2 stays exact for flat and
// sharp angles.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

Topology find_topology(std::span<const TriangleIndices> triangles, std::size_t vertex_count) {
  Topology topology;
  topology.neighbours.assign(triangles.size(), {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  EdgeTable edges(triangles, vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::span<const HalfEdge> rest = edges.at(v);
    while (!rest.empty()) {
      const auto other = std::ranges::find_if(
          rest, [&](const HalfEdge& e) { return e.larger_vertex != rest.front().larger_vertex; });
      const auto count = static_cast<std::size_t>(other - rest.begin());
      take_edge(topology, rest.first(count));
      rest = rest.subspan(count);
    }
  }
  return topology;
}

std::vector<Float3> angle_weighted_normals(std::span<const Float3> vertices,
                                           std::span<const TriangleIndices> triangles) {
  std::vector<Vec3> sums(vertices.size(), Vec3::Zero());
  for (const TriangleIndices& t : triangles) {
    const Vec3 a = to_vec3(vertices[t[0]]);
    const Vec3 b = to_vec3(vertices[t[1]]);
    const Vec3 c = to_vec3(vertices[t[2]]);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const double angle_a = angle_between(b - a, c - a);
    const double angle_b = angle_between(c - b, a - b);
    sums[t[0]] += normal * angle_a;
    sums[t[1]] += normal * angle_b;
    sums[t[2]] += normal * (M_PI - angle_a - angle_b);
  }
  std::vector<Float3> normals(vertices.size());
  std::ranges::transform(sums, normals.begin(), [](const Vec3& sum) {
    const double length = sum.norm();
    return length > 1e-12 ? to_float3(sum / length) : Float3{};
  });
  return normals;
}

}  // namespace tactus::host
