#include "host_tools/bake/scene/corner_normals.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

using rendering::CornerNormals;
using rendering::Float3;
using rendering::kNoNeighbour;
using rendering::TriangleIndices;
using rendering::TriangleNeighbours;

// The most triangles that are visited around one vertex. It ends the walk in a damaged mesh whose
// neighbours form no fan.
constexpr std::size_t kMostAbout = 4096;

// A corner of a triangle; `triangle` is kNoNeighbour for none.
struct Corner {
  std::uint32_t triangle = kNoNeighbour;
  std::size_t number = 0;
};

// The corner after and before, in the winding's direction.
std::size_t next(std::size_t corner) {
  return (corner + 1) % 3;
}
std::size_t previous(std::size_t corner) {
  return (corner + 2) % 3;
}

// Walks around vertices from triangle to triangle, with normals and corner angles computed once.
class Fans {
 public:
  Fans(std::span<const Float3> vertices, std::span<const TriangleIndices> triangles,
       std::span<const TriangleNeighbours> neighbours, double angle_limit_rad)
      : triangles_(triangles), neighbours_(neighbours), least_cosine_(std::cos(angle_limit_rad)) {
    for (const TriangleIndices& t : triangles) {
      std::array<Vec3, 3> p;
      std::ranges::transform(t, p.begin(), [&](std::uint32_t v) { return to_vec3(vertices[v]); });
      normals_.push_back((p[1] - p[0]).cross(p[2] - p[0]).normalized());
      std::array<double, 3>& angles = angles_.emplace_back();
      for (std::size_t k = 0; k < angles.size(); ++k) {
        // atan2 of cross and dot product is exact for very flat and very sharp angles, where acos
        // is not.
        const Vec3 out = p[next(k)] - p[k];
        const Vec3 back = p[previous(k)] - p[k];
        angles[k] = std::atan2(out.cross(back).norm(), out.dot(back));
      }
    }
  }

  // Returns the normal at a corner: first it walks one way around the vertex; if a sharp or open
  // edge ends the walk, it walks the other way too.
  [[nodiscard]] Vec3 normal_at(const Corner& start) const {
    Vec3 sum = weighted(start);
    std::size_t about = 1;
    Corner at = start;
    for (at = across(at, true); is_other(at, start, about); at = across(at, true)) {
      sum += weighted(at);
      ++about;
    }
    if (at.triangle != start.triangle) {
      for (at = across(start, false); is_other(at, start, about); at = across(at, false)) {
        sum += weighted(at);
        ++about;
      }
    }
    const double length = sum.norm();
    // Faces that cancel out have no mean; the triangle's own normal is then the best that there is.
    constexpr double kCancelled = 1e-6;
    return length > kCancelled ? Vec3{sum / length} : normals_[start.triangle];
  }

 private:
  // Returns true while the walk goes on: at a triangle, not the first one, and not for ever.
  static bool is_other(const Corner& at, const Corner& start, std::size_t about) {
    return at.triangle != kNoNeighbour && at.triangle != start.triangle && about < kMostAbout;
  }

  // Returns the triangle's normal times its angle at the vertex, so that the cut of a face into
  // triangles does not matter (Thurmer and Wuthrich, 1998).
  [[nodiscard]] Vec3 weighted(const Corner& at) const {
    return angles_[at.triangle][at.number] * normals_[at.triangle];
  }

  // Returns the corner at the same vertex in the triangle across an edge of `at`: the edge that
  // leaves the vertex in the winding's direction, or the one that arrives. Returns no corner across
  // an open or sharp edge, or if the other triangle is wound the other way.
  [[nodiscard]] Corner across(const Corner& at, bool leaving) const {
    const TriangleIndices& here = triangles_[at.triangle];
    const std::size_t edge = leaving ? at.number : previous(at.number);
    const std::uint32_t other = neighbours_[at.triangle][edge];
    if (other == kNoNeighbour || normals_[at.triangle].dot(normals_[other]) < least_cosine_) {
      return {};
    }
    const TriangleIndices& there = triangles_[other];
    const auto found = std::ranges::find(there, here[at.number]);
    const auto number = static_cast<std::size_t>(found - there.begin());
    const std::uint32_t far = leaving ? here[next(at.number)] : here[previous(at.number)];
    if (found == there.end() || there[leaving ? previous(number) : next(number)] != far) {
      return {};
    }
    return {.triangle = other, .number = number};
  }

  std::span<const TriangleIndices> triangles_;
  std::span<const TriangleNeighbours> neighbours_;
  double least_cosine_;
  std::vector<Vec3> normals_;
  std::vector<std::array<double, 3>> angles_;
};

}  // namespace

std::vector<CornerNormals> corner_normals(std::span<const Float3> vertices,
                                          std::span<const TriangleIndices> triangles,
                                          std::span<const TriangleNeighbours> neighbours,
                                          double angle_limit_rad) {
  const Fans fans(vertices, triangles, neighbours, angle_limit_rad);
  std::vector<CornerNormals> result(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[t][k] = rendering::encode(fans.normal_at({.triangle = t, .number = k}));
    }
  }
  return result;
}

}  // namespace tactus::host
