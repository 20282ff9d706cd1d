#include "host_tools/bake/scene/hole_caps.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "host_tools/bake/scene/mesh_cleanup.h"
#include "host_tools/bake/scene/open_loops.h"
#include "host_tools/input_error.h"
#include "host_tools/units.h"

namespace tactus::host {
namespace {

using rendering::TriangleIndices;

// A corner of the hole that is left.
struct HoleCorner {
  std::uint32_t vertex = 0;
  std::array<float, 2> texture_place{};
};

using CapTriangle = std::array<HoleCorner, 3>;

std::pair<std::uint32_t, std::uint32_t> edge_of(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// Returns the edges of the mesh between corners of loops: a cap must not make one of them again.
Edges edges_between(const TriangleMesh& mesh, std::span<const OpenLoop> loops) {
  std::vector<bool> is_corner(mesh.vertices.size());
  for (const OpenLoop& loop : loops) {
    for (const MeshCorner& at : loop.corners) {
      is_corner[mesh.triangles[at.triangle][at.corner]] = true;
    }
  }
  Edges edges;
  for (const TriangleIndices& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_corner[t[k]] && is_corner[t[(k + 1) % 3]]) {
        edges.insert(edge_of(t[k], t[(k + 1) % 3]));
      }
    }
  }
  return edges;
}

// One hole, from which ears are cut until a triangle is left.
class Hole {
 public:
  // The hole runs against the edges of the loop, since a cap's triangles have them the other way.
  // `edges` are those that are there, to which the cap's own are added.
  Hole(TriangleMesh& mesh, const OpenLoop& loop, Edges& edges) : mesh_(mesh), edges_(edges) {
    for (const auto& at : std::views::reverse(loop.corners)) {
      HoleCorner& corner = left_.emplace_back();
      corner.vertex = mesh.triangles[at.triangle][at.corner];
      if (!mesh.corner_places.empty()) {
        corner.texture_place = mesh.corner_places[at.triangle][at.corner];
      }
    }
    // Newell's normal: the sum of the triangles that all corners make with one point.
    for (std::size_t i = 0; i < left_.size(); ++i) {
      normal_ += (place(i) - place(0)).cross(place((i + 1) % left_.size()) - place(0));
    }
  }

  // Returns the cap's triangles, or nothing if there are none. A part of the hole that has no ear
  // left becomes a fan.
  std::optional<std::vector<CapTriangle>> cap() {
    std::vector<CapTriangle> triangles;
    while (left_.size() > 3) {
      const std::optional<std::size_t> ear = best_ear();
      if (!ear) {
        return add_fan(triangles) ? std::optional(triangles) : std::nullopt;
      }
      triangles.push_back(corners(*ear));
      edges_.insert(edge_of(triangles.back()[0].vertex, triangles.back()[2].vertex));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(*ear));
    }
    if (left_.size() < 3 || !(height(1) >= kDegenerateHeight_m)) {
      return std::nullopt;
    }
    triangles.push_back(corners(1));
    return triangles;
  }

 private:
  [[nodiscard]] Vec3 place(std::size_t i) const {
    return rendering::to_vec3(mesh_.vertices[left_[i].vertex]);
  }
  [[nodiscard]] CapTriangle corners(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }
  [[nodiscard]] std::array<Vec3, 3> places(std::size_t i) const {
    const std::size_t n = left_.size();
    return {place((i + n - 1) % n), place(i), place((i + 1) % n)};
  }

  // Returns the smallest height of the ear at a corner; 0 if it is not convex.
  [[nodiscard]] double height(std::size_t i) const {
    const auto& [a, b, c] = places(i);
    const Vec3 across = (b - a).cross(c - a);
    if (left_.size() > 3 && !(across.dot(normal_) > 0.0)) {
      return 0.0;
    }
    return across.norm() / std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  }

  // Returns the share of the ear's smallest height in its longest side: the best ear is the most
  // even one.
  [[nodiscard]] double evenness(std::size_t i) const {
    const auto& [a, b, c] = places(i);
    return height(i) / std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  }

  // Returns true if no other corner lies in the ear, as seen along the normal, and its third side
  // is no edge yet.
  [[nodiscard]] bool is_ear(std::size_t i) const {
    const CapTriangle ear = corners(i);
    if (ear[0].vertex == ear[2].vertex || !(height(i) >= kDegenerateHeight_m) ||
        edges_.contains(edge_of(ear[0].vertex, ear[2].vertex))) {
      return false;
    }
    const auto& [a, b, c] = places(i);
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const std::uint32_t v = left_[k].vertex;
      const Vec3 p = place(k);
      if (v != ear[0].vertex && v != ear[1].vertex && v != ear[2].vertex &&
          (b - a).cross(p - a).dot(normal_) >= 0.0 && (c - b).cross(p - b).dot(normal_) >= 0.0 &&
          (a - c).cross(p - c).dot(normal_) >= 0.0) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::optional<std::size_t> best_ear() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (is_ear(i) && (!best || evenness(i) > evenness(*best))) {
        best = i;
      }
    }
    return best;
  }

  // Adds a fan from a new vertex in the middle of what is left. Returns false, and adds none, if a
  // triangle of it would be folded over.
  bool add_fan(std::vector<CapTriangle>& triangles) {
    HoleCorner middle{.vertex = static_cast<std::uint32_t>(mesh_.vertices.size())};
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < left_.size(); ++i) {
      sum += place(i);
      for (std::size_t k = 0; k < 2; ++k) {
        middle.texture_place[k] += left_[i].texture_place[k] / static_cast<float>(left_.size());
      }
    }
    const rendering::Float3 at = rendering::to_float3(sum / static_cast<double>(left_.size()));
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const std::size_t next = (i + 1) % left_.size();
      const Vec3 across =
          (place(i) - rendering::to_vec3(at)).cross(place(next) - rendering::to_vec3(at));
      if (!(across.dot(normal_) > 0.0)) {
        return false;
      }
      triangles.push_back({left_[i], left_[next], middle});
    }
    mesh_.vertices.push_back(at);
    return true;
  }

  TriangleMesh& mesh_;
  std::vector<HoleCorner> left_;
  Vec3 normal_ = Vec3::Zero();
  Edges& edges_;
};

}  // namespace

HoleCaps cap_holes(TriangleMesh& mesh, double most_m) {
  HoleCaps caps;
  std::vector<OpenLoop> loops = find_open_loops(mesh.vertices, mesh.triangles);
  std::erase_if(loops, [&](const OpenLoop& loop) { return loop.size_m > most_m; });
  Edges edges = edges_between(mesh, loops);
  for (const OpenLoop& loop : loops) {
    const auto cap = loop.is_closed ? Hole(mesh, loop, edges).cap() : std::nullopt;
    if (!cap) {
      throw InputError(fmt::format(
          "the hole of {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) m cannot be closed by triangles; "
          "repair the mesh, or write a cap_holes_mm below its size",
          kMillimetresPerMetre * loop.size_m, loop.middle_W.x(), loop.middle_W.y(),
          loop.middle_W.z()));
    }
    for (const CapTriangle& t : *cap) {
      mesh.triangles.push_back({t[0].vertex, t[1].vertex, t[2].vertex});
      if (!mesh.corner_places.empty()) {
        mesh.corner_places.push_back({t[0].texture_place, t[1].texture_place, t[2].texture_place});
      }
    }
    ++caps.holes;
    caps.triangles += cap->size();
  }
  return caps;
}

}  // namespace tactus::host
