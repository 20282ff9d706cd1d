// The search goes on from the end of an open edge round the vertex, from triangle to triangle, to
// the next open edge. Where it comes to a vertex again, the part since then is a loop of its own:
// so two holes that meet in a vertex are two.
#include "host_tools/bake/scene/open_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

#include "host_tools/bake/scene/mesh_topology.h"
#include "host_tools/units.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::kNoNeighbour;
using rendering::TriangleIndices;

MeshCorner next_in_triangle(const MeshCorner& at) {
  return {at.triangle, (at.corner + 1) % 3};
}

// The edges of a mesh and the corners at which they begin.
class OpenEdges {
 public:
  OpenEdges(std::span<const TriangleIndices> triangles, std::size_t vertex_count)
      : triangles_(triangles), topology_(find_topology(triangles, vertex_count)) {
    find_shared();
  }

  [[nodiscard]] std::uint32_t vertex(const MeshCorner& at) const {
    return triangles_[at.triangle][at.corner];
  }

  // Returns true if the edge that begins at a corner belongs to no other triangle.
  [[nodiscard]] bool is_open(const MeshCorner& at) const {
    return topology_.neighbours[at.triangle][at.corner] == kNoNeighbour && !is_shared(at);
  }

  // Returns the corner at which the open edge begins that comes after one; nothing if there is
  // none.
  [[nodiscard]] std::optional<MeshCorner> next(const MeshCorner& open) const {
    MeshCorner at = next_in_triangle(open);
    const std::uint32_t pivot = vertex(at);
    for (std::size_t turn = 0; turn < triangles_.size(); ++turn) {
      const std::uint32_t across = topology_.neighbours[at.triangle][at.corner];
      if (across == kNoNeighbour) {
        return is_open(at) ? std::optional(at) : std::nullopt;
      }
      // The neighbour has the edge the other way round: it ends at the pivot.
      const TriangleIndices& t = triangles_[across];
      const auto place = static_cast<std::uint32_t>(std::ranges::find(t, pivot) - t.begin());
      const MeshCorner there{across, place};
      if (topology_.neighbours[across][(place + 2) % 3] != at.triangle) {
        return std::nullopt;
      }
      at = there;
    }
    return std::nullopt;
  }

 private:
  // Returns the two vertices of an edge as one number.
  [[nodiscard]] std::uint64_t key(const MeshCorner& at) const {
    const std::uint32_t from = vertex(at);
    const std::uint32_t to = vertex(next_in_triangle(at));
    return (std::uint64_t{std::min(from, to)} << 32U) | std::max(from, to);
  }

  // Finds the edges that have no neighbour since three triangles or more share them.
  void find_shared() {
    std::vector<std::uint64_t> lonely;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (topology_.neighbours[i][k] == kNoNeighbour) {
          lonely.push_back(key({i, k}));
        }
      }
    }
    std::ranges::sort(lonely);
    for (std::size_t i = 1; i < lonely.size(); ++i) {
      if (lonely[i] == lonely[i - 1] && (shared_.empty() || shared_.back() != lonely[i])) {
        shared_.push_back(lonely[i]);
      }
    }
  }

  [[nodiscard]] bool is_shared(const MeshCorner& at) const {
    return std::ranges::binary_search(shared_, key(at));
  }

  std::span<const TriangleIndices> triangles_;
  Topology topology_;
  // Sorted.
  std::vector<std::uint64_t> shared_;
};

void measure(OpenLoop& loop, std::span<const Float3> vertices,
             std::span<const TriangleIndices> triangles) {
  const auto place = [&](const MeshCorner& at, std::uint32_t more) {
    return rendering::to_vec3(vertices[triangles[at.triangle][(at.corner + more) % 3]]);
  };
  Vec3 lower = place(loop.corners.front(), 0);
  Vec3 upper = lower;
  const auto each = [&](auto use) {
    for (const MeshCorner& at : loop.corners) {
      use(place(at, 0));
      use(place(at, 1));
    }
  };
  each([&](const Vec3& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  });
  loop.middle_W = 0.5 * (lower + upper);
  each([&](const Vec3& p) {
    loop.size_m = std::max(loop.size_m, 2.0 * (p - loop.middle_W).norm());
  });
}

}  // namespace

std::vector<OpenLoop> find_open_loops(std::span<const Float3> vertices,
                                      std::span<const TriangleIndices> triangles) {
  const OpenEdges edges(triangles, vertices.size());
  std::vector<std::array<bool, 3>> is_done(triangles.size());
  const auto done = [&](const MeshCorner& at) -> bool& { return is_done[at.triangle][at.corner]; };
  // The edges at which a loop that is not closed begins are those that follow on none.
  std::vector<std::array<bool, 3>> follows(triangles.size());
  std::vector<MeshCorner> open;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (edges.is_open({i, k})) {
        open.push_back({i, k});
        if (const auto next = edges.next({i, k})) {
          follows[next->triangle][next->corner] = true;
        }
      }
    }
  }
  std::ranges::stable_partition(
      open, [&](const MeshCorner& at) { return !follows[at.triangle][at.corner]; });
  std::vector<OpenLoop> loops;
  // The place in the walk of each vertex that it has come to.
  std::unordered_map<std::uint32_t, std::size_t> places;
  for (const MeshCorner& first : open) {
    std::vector<MeshCorner> walk;
    places.clear();
    const auto come_to = [&](std::uint32_t vertex) {
      const auto [found, is_new] = places.try_emplace(vertex, walk.size());
      if (is_new) {
        return;
      }
      const auto from = walk.begin() + static_cast<std::ptrdiff_t>(found->second);
      OpenLoop& loop = loops.emplace_back(OpenLoop{.corners = {from, walk.end()}});
      for (const MeshCorner& at : loop.corners) {
        if (edges.vertex(at) != vertex) {
          places.erase(edges.vertex(at));
        }
      }
      walk.erase(from, walk.end());
    };
    for (std::optional at(first); at && !done(*at); at = edges.next(*at)) {
      come_to(edges.vertex(*at));
      done(*at) = true;
      walk.push_back(*at);
    }
    if (!walk.empty()) {
      come_to(edges.vertex(next_in_triangle(walk.back())));
    }
    if (!walk.empty()) {
      loops.push_back({.corners = std::move(walk), .is_closed = false});
    }
  }
  for (OpenLoop& loop : loops) {
    measure(loop, vertices, triangles);
  }
  std::ranges::stable_sort(loops, std::ranges::greater{}, &OpenLoop::size_m);
  return loops;
}

std::string text_of_loops(std::span<const OpenLoop> loops) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (const OpenLoop& loop : loops.first(std::min(kMost, loops.size()))) {
    text += fmt::format("{}{:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m", text.empty() ? "" : ", ",
                        kMillimetresPerMetre * loop.size_m, loop.middle_W.x(), loop.middle_W.y(),
                        loop.middle_W.z());
  }
  if (loops.empty()) {
    return text;
  }
  return fmt::format("{} hole{}: {}{}", loops.size(), loops.size() == 1 ? "" : "s", text,
                     loops.size() > kMost ? ", ..." : "");
}

double cap_holes_mm_for(std::span<const OpenLoop> loops) {
  constexpr double kMore = 1.01;
  return loops.empty() ? 0.0 : kMore * kMillimetresPerMetre * loops.front().size_m;
}

}  // namespace tactus::host
