#include "host_tools/mesh/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace tactus::host {
namespace {

using Tetrahedron = std::array<std::size_t, 4>;

// Corner k of a cube is at x = k & 1, y = k >> 1 & 1, z = k >> 2. The six tetrahedra lie round the
// diagonal from corner 0 to 7. Neighbouring cubes cut the face between them along the same
// diagonal, so the mesh has no cracks.
constexpr std::array<Tetrahedron, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

// Holds the function's values at all points of the grid, and the mesh that grows from them.
class Mesher {
 public:
  Mesher(const LevelFunction& function, const Vec3& lower, const Vec3& upper, int cells)
      : function_(function), lower_(lower), step_((upper - lower) / cells) {
    points_.fill(static_cast<std::size_t>(cells) + 1);
    values_.reserve(points_[0] * points_[1] * points_[2]);
    for (std::size_t z = 0; z < points_[2]; ++z) {
      for (std::size_t y = 0; y < points_[1]; ++y) {
        for (std::size_t x = 0; x < points_[0]; ++x) {
          const double value = function(place(number(x, y, z)));
          // A point where the function is not defined counts as outside.
          values_.push_back(std::isfinite(value) ? value : 1.0);
        }
      }
    }
  }

  TriangleMesh mesh() {
    for (std::size_t z = 0; z + 1 < points_[2]; ++z) {
      for (std::size_t y = 0; y + 1 < points_[1]; ++y) {
        for (std::size_t x = 0; x + 1 < points_[0]; ++x) {
          cut_cube(x, y, z);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  // Returns the index of a grid point; x counts fastest.
  [[nodiscard]] std::size_t number(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * points_[1] + y) * points_[0] + x;
  }

  // Returns the position of a grid point, m, world frame.
  [[nodiscard]] Vec3 place(std::size_t point) const {
    const std::size_t x = point % points_[0];
    const std::size_t y = point / points_[0] % points_[1];
    const std::size_t z = point / (points_[0] * points_[1]);
    const Vec3 steps{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    return lower_ + step_.cwiseProduct(steps);
  }

  [[nodiscard]] bool inside(std::size_t point) const { return values_[point] < 0.0; }

  void cut_cube(std::size_t x, std::size_t y, std::size_t z) {
    std::array<std::size_t, 8> corner;
    for (std::size_t k = 0; k < 8; ++k) {
      corner[k] = number(x + (k & 1U), y + (k >> 1 & 1U), z + (k >> 2));
    }
    for (const Tetrahedron& t : kTetrahedra) {
      cut({corner[t[0]], corner[t[1]], corner[t[2]], corner[t[3]]});
    }
  }

  // Adds the part of the surface inside one tetrahedron. Zero or four points inside: none. One or
  // three: a triangle round the odd point. Two and two: a quadrilateral, as two triangles.
  void cut(const Tetrahedron& t) {
    Tetrahedron in{};
    Tetrahedron out{};
    std::size_t in_count = 0;
    std::size_t out_count = 0;
    for (const std::size_t point : t) {
      (inside(point) ? in[in_count++] : out[out_count++]) = point;
    }
    if (in_count == 1) {
      add(crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]), in[0]);
    } else if (in_count == 3) {
      add(crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]), in[0]);
    } else if (in_count == 2) {
      const std::uint32_t a = crossing(in[0], out[0]);
      const std::uint32_t b = crossing(in[0], out[1]);
      const std::uint32_t c = crossing(in[1], out[1]);
      const std::uint32_t d = crossing(in[1], out[0]);
      add(a, b, c, in[0]);
      add(a, c, d, in[0]);
    }
  }

  // Adds a triangle, wound so that `point_inside` is behind it.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t point_inside) {
    const Vec3 pa = rendering::to_vec3(mesh_.vertices[a]);
    const Vec3 pb = rendering::to_vec3(mesh_.vertices[b]);
    const Vec3 pc = rendering::to_vec3(mesh_.vertices[c]);
    if ((pb - pa).cross(pc - pa).dot(place(point_inside) - pa) > 0.0) {
      std::swap(b, c);
    }
    mesh_.triangles.push_back({a, b, c});
  }

  // Finds the zero between a point inside and one outside. Bisection instead of interpolation: a
  // polynomial of high degree is far from straight within a part. 12 halvings leave 1/4096 of the
  // edge.
  [[nodiscard]] Vec3 zero_between(Vec3 in, Vec3 out) const {
    constexpr int kHalvings = 12;
    for (int i = 0; i < kHalvings; ++i) {
      const Vec3 middle = 0.5 * (in + out);
      (function_(middle) < 0.0 ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  // Returns the vertex on the edge between two grid points. Up to six tetrahedra share an edge; the
  // first one makes the vertex.
  std::uint32_t crossing(std::size_t in, std::size_t out) {
    const std::size_t key = std::min(in, out) * values_.size() + std::max(in, out);
    const auto [found, is_new] =
        crossings_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(rendering::to_float3(zero_between(place(in), place(out))));
    }
    return found->second;
  }

  const LevelFunction& function_;
  Vec3 lower_;
  Vec3 step_;
  std::array<std::size_t, 3> points_{};
  std::vector<double> values_;
  std::unordered_map<std::size_t, std::uint32_t> crossings_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh mesh_level_set(const LevelFunction& function, const Vec3& lower_W, const Vec3& upper_W,
                            int cells) {
  return Mesher(function, lower_W, upper_W, cells).mesh();
}

}  // namespace tactus::host
