#include "host_tools/bake/scene/mesh_cleanup.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <ranges>
#include <unordered_map>
#include <utility>

#include "host_tools/bake/scene/mesh_topology.h"
#include "host_tools/bake/scene/open_loops.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::TriangleIndices;

// No vertex, in tables of vertex numbers.
constexpr std::uint32_t kNone = 0xffffffff;

// Returns the bits of a number well mixed, for hash tables.
std::uint64_t mix(std::uint64_t value) {
  // The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every input bit reaches every output
  // bit.
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

// Returns the bits of a number; adding zero gives -0 and 0, which are equal, the same bits.
std::uint64_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0F);
}

std::uint64_t hash_position(const Float3& p) {
  return mix(mix((bits(p.x) << 32U) | bits(p.y)) + bits(p.z));
}

// Returns for each vertex the first one at exactly the same place. A hash table with open
// addressing takes half the time of a node-based map for the Stanford dragon.
std::vector<std::uint32_t> first_at_same_place(std::span<const Float3> vertices) {
  const std::size_t slots = std::bit_ceil(2 * vertices.size() + 1);
  std::vector<std::uint32_t> table(slots, kNone);
  std::vector<std::uint32_t> first(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    std::size_t slot = static_cast<std::size_t>(hash_position(vertices[i])) & (slots - 1);
    while (table[slot] != kNone && vertices[table[slot]] != vertices[i]) {
      slot = (slot + 1) & (slots - 1);
    }
    if (table[slot] == kNone) {
      table[slot] = i;
    }
    first[i] = table[slot];
  }
  return first;
}

// A cell of the grid, counted in tolerances.
using Cell = std::array<std::int64_t, 3>;

// The hash of a cell, for std::unordered_map.
struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cell) {
      hash = mix(hash + static_cast<std::uint64_t>(k));
    }
    return static_cast<std::size_t>(hash);
  }
};

// The kept vertices in a grid whose cells are as wide as the tolerance, so that every vertex within
// the tolerance is in one of the 27 cells around.
class NearGrid {
 public:
  NearGrid(std::span<const Float3> vertices, double tolerance_m)
      : vertices_(vertices), tolerance_m_(tolerance_m) {}

  // Returns the first kept vertex within the tolerance; if there is none, keeps this one.
  std::uint32_t find_or_keep(std::uint32_t index) {
    const Cell home = cell_of(vertices_[index]);
    std::uint32_t best = kNone;
    for (std::int64_t n = 0; n < 27; ++n) {
      const Cell near{home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1};
      const auto found = cells_.find(near);
      if (found != cells_.end()) {
        best = std::min(best, first_near(found->second, index));
      }
    }
    if (best == kNone) {
      cells_[home].push_back(index);
      return index;
    }
    return best;
  }

 private:
  // Returns the cell whose middle is nearest.
  [[nodiscard]] Cell cell_of(const Float3& p) const {
    const Vec3 scaled = to_vec3(p) / tolerance_m_;
    return {std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())};
  }

  // Returns the first of `kept` within the tolerance, kNone if there is none.
  [[nodiscard]] std::uint32_t first_near(std::span<const std::uint32_t> kept,
                                         std::uint32_t index) const {
    const Vec3 p = to_vec3(vertices_[index]);
    const auto near = std::ranges::find_if(kept, [&](std::uint32_t other) {
      return (to_vec3(vertices_[other]) - p).norm() <= tolerance_m_;
    });
    return near == kept.end() ? kNone : *near;
  }

  std::span<const Float3> vertices_;
  double tolerance_m_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

// Returns true if two corners are the same vertex, or the triangle is thinner than
// kDegenerateHeight_m.
bool is_degenerate(const TriangleMesh& mesh, const TriangleIndices& t) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
    return true;
  }
  const Vec3 a = to_vec3(mesh.vertices[t[0]]);
  const Vec3 ab = to_vec3(mesh.vertices[t[1]]) - a;
  const Vec3 ac = to_vec3(mesh.vertices[t[2]]) - a;
  const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  const double smallest_height = ab.cross(ac).norm() / longest;
  // Written so that a height of NaN counts as degenerate.
  return !(smallest_height >= kDegenerateHeight_m);
}

}  // namespace

std::uint32_t weld(TriangleMesh& mesh, double weld_m) {
  std::vector<std::uint32_t> target = first_at_same_place(mesh.vertices);
  if (weld_m > 0.0) {
    NearGrid grid(mesh.vertices, weld_m);
    for (std::uint32_t i = 0; i < target.size(); ++i) {
      target[i] = target[i] == i ? grid.find_or_keep(i) : target[target[i]];
    }
  }
  // Vertices that stay move up to fill the gaps; the others take the new number of their target.
  std::vector<Float3> kept;
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    if (target[i] == i) {
      target[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(mesh.vertices[i]);
    } else {
      // The target has a smaller number, so it has its new place already.
      target[i] = target[target[i]];
    }
  }
  for (TriangleIndices& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      vertex = target[vertex];
    }
  }
  const auto gone = static_cast<std::uint32_t>(mesh.vertices.size() - kept.size());
  mesh.vertices = std::move(kept);
  return gone;
}

std::uint32_t weld_rims(TriangleMesh& mesh) {
  std::vector<std::uint32_t> target(mesh.vertices.size());
  const std::ranges::iota_view numbers(std::uint32_t{0}, static_cast<std::uint32_t>(target.size()));
  std::ranges::copy(numbers, target.begin());
  std::uint32_t gone = 0;
  NearGrid grid(mesh.vertices, kRimGap_m);
  for (const OpenLoop& loop : find_open_loops(mesh.vertices, mesh.triangles)) {
    for (const MeshCorner& at : loop.corners) {
      const std::uint32_t vertex = mesh.triangles[at.triangle][at.corner];
      if (target[vertex] == vertex) {
        target[vertex] = grid.find_or_keep(vertex);
        gone += target[vertex] == vertex ? 0U : 1U;
      }
    }
  }
  if (gone == 0) {
    return 0;
  }
  TriangleMesh closed{.vertices = mesh.vertices, .triangles = mesh.triangles};
  for (TriangleIndices& triangle : closed.triangles) {
    for (std::uint32_t& vertex : triangle) {
      vertex = target[vertex];
    }
  }
  const auto faults = [](const TriangleMesh& of) {
    const Topology topology = find_topology(of.triangles, of.vertices.size());
    return topology.non_manifold_edges + topology.inconsistent_edges;
  };
  const bool loses_area = std::ranges::any_of(
      closed.triangles, [&](const TriangleIndices& t) { return is_degenerate(closed, t); });
  if (loses_area || faults(closed) > faults(mesh)) {
    return 0;
  }
  mesh.triangles = std::move(closed.triangles);
  return gone;
}

std::uint32_t drop_degenerate(TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_degenerate(mesh, mesh.triangles[i])) {
      continue;
    }
    mesh.triangles[kept] = mesh.triangles[i];
    if (!mesh.corner_places.empty()) {
      mesh.corner_places[kept] = mesh.corner_places[i];
    }
    ++kept;
  }
  const std::size_t gone = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  mesh.corner_places.resize(mesh.corner_places.empty() ? 0 : kept);
  return static_cast<std::uint32_t>(gone);
}

void order_vertices_by_use(TriangleMesh& mesh) {
  std::vector<std::uint32_t> place(mesh.vertices.size(), kNone);
  std::vector<Float3> ordered;
  ordered.reserve(mesh.vertices.size());
  for (TriangleIndices& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      if (place[vertex] == kNone) {
        place[vertex] = static_cast<std::uint32_t>(ordered.size());
        ordered.push_back(mesh.vertices[vertex]);
      }
      vertex = place[vertex];
    }
  }
  mesh.vertices = std::move(ordered);
}

}  // namespace tactus::host
