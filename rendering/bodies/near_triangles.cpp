#include "rendering/bodies/near_triangles.h"

#include <algorithm>
#include <bit>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// A search looks at no more triangles than this.
constexpr std::size_t kMostSeen = 4096;
// Hulls of more faces are not compared face by face.
constexpr std::size_t kFewFaces = 12;

// Returns true if a plane, of the hull or of the triangle, keeps both farther apart than the
// margin.
bool is_apart(const PlacedHull& hull, const NearTriangle& triangle, double margin_m) {
  const double reach = margin_m + hull.hull().radius_m;
  const auto& [a, b, c] = triangle.corners_O;
  double lowest = (hull.vertices_W()[0] - a).dot(triangle.normal_O);
  double highest = lowest;
  for (const Vec3& vertex : hull.vertices_W()) {
    const double height = (vertex - a).dot(triangle.normal_O);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (lowest > reach || highest < -reach) {
    return true;
  }
  const std::size_t faces = hull.hull().faces.size();
  for (std::size_t f = 0; f < faces && faces <= kFewFaces; ++f) {
    const Vec3 normal = hull.normal_W(f);
    const double face = hull.vertices_W()[hull.corners(f).front()].dot(normal) + reach;
    if (std::min({a.dot(normal), b.dot(normal), c.dot(normal)}) > face) {
      return true;
    }
  }
  return false;
}

// Returns true if the triangle's box, grown by the margin, holds a vertex of the hull.
bool is_at_vertex(const PlacedHull& hull, const NearTriangle& triangle, double margin_m) {
  const auto& [a, b, c] = triangle.corners_O;
  const Vec3 reach = Vec3::Constant(margin_m + hull.hull().radius_m);
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c) - reach;
  const Vec3 upper = a.cwiseMax(b).cwiseMax(c) + reach;
  return std::ranges::any_of(hull.vertices_W(), [&](const Vec3& vertex) {
    return (vertex.array() >= lower.array()).all() && (vertex.array() <= upper.array()).all();
  });
}

// Returns the numbers of an edge's ends, the smaller one first.
std::array<std::uint32_t, 2> ends_of(const NearTriangle& triangle, std::size_t edge) {
  const std::uint32_t from = triangle.numbers[edge];
  const std::uint32_t to = triangle.numbers[(edge + 1) % 3];
  return {std::min(from, to), std::max(from, to)};
}

}  // namespace

// A walk through the mesh's hierarchy that adds triangles to a list.
struct TriangleSearch {
  NearTriangles& found;
  const MeshView& mesh;
  Sides sides;
  const PlacedHull& hull;
  double margin_m;
  bool only_at_vertices;
  std::size_t seen = 0;
  bool has_overflowed = false;

  [[nodiscard]] bool exhausted() const { return has_overflowed; }

  void operator()(std::uint32_t t) {
    if (has_overflowed || ++seen > kMostSeen) {
      has_overflowed = true;
      return;
    }
    NearTriangle triangle{.numbers = mesh.triangles[t]};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners_O[k] = to_vec3(mesh.vertices[triangle.numbers[k]]);
    }
    auto& [a, b, c] = triangle.corners_O;
    const Vec3 normal = (b - a).cross(c - a);
    const double length = normal.norm();
    if (!(length > 0.0)) {
      return;
    }
    triangle.normal_O = normal / length;
    if ((hull.middle_W() - a).dot(normal) < 0.0) {
      triangle.stops = sides == Sides::two;
      if (triangle.stops) {
        triangle.normal_O = -triangle.normal_O;
        std::swap(b, c);
        std::swap(triangle.numbers[1], triangle.numbers[2]);
      }
    }
    if (is_apart(hull, triangle, margin_m) ||
        (only_at_vertices && !is_at_vertex(hull, triangle, margin_m))) {
      return;
    }
    if (found.count_ == kMaxNearTriangles) {
      has_overflowed = true;
      return;
    }
    found.triangles_[found.count_++] = triangle;
  }
};

void NearTriangles::find(const MeshView& mesh, Sides sides, const PlacedHull& hull_O,
                         double margin_m) {
  is_partial_ = false;
  for (const bool only_at_vertices : {false, true}) {
    count_ = 0;
    TriangleSearch search{.found = *this,
                          .mesh = mesh,
                          .sides = sides,
                          .hull = hull_O,
                          .margin_m = margin_m,
                          .only_at_vertices = only_at_vertices};
    visit_all_near(mesh.nodes, hull_O.middle_W(), hull_O.half_W(),
                   margin_m + hull_O.hull().radius_m, search);
    if (!search.has_overflowed) {
      break;
    }
    is_partial_ = true;
  }
  connect();
}

void NearTriangles::connect() {
  constexpr std::size_t kPlaces = std::bit_ceil(4 * kMaxNearTriangles);
  // The places of edges that wait for their neighbour: three times the triangle plus the edge.
  std::array<std::uint16_t, kPlaces> waiting;
  waiting.fill(NearTriangle::kNone);
  const auto count = static_cast<std::uint16_t>(count_);
  for (std::uint16_t t = 0; t < count; ++t) {
    for (std::uint16_t k = 0; k < 3; ++k) {
      const auto [low, high] = ends_of(triangles_[t], k);
      // Two odd multipliers spread the numbers of an edge over the places.
      std::size_t place = (low * 0x9e3779b1U ^ high * 0x85ebca6bU) >> 7 & (kPlaces - 1);
      for (; waiting[place] != NearTriangle::kNone; place = (place + 1) & (kPlaces - 1)) {
        const std::uint16_t other = waiting[place] / 3;
        const std::uint16_t edge = waiting[place] % 3;
        const auto [other_low, other_high] = ends_of(triangles_[other], edge);
        if (other_low != low || other_high != high) {
          continue;
        }
        if (triangles_[other].across[edge] == NearTriangle::kNone) {
          triangles_[other].across[edge] = t;
          triangles_[t].across[k] = other;
        }
        break;
      }
      if (waiting[place] == NearTriangle::kNone) {
        waiting[place] = static_cast<std::uint16_t>(3 * t + k);
      }
    }
  }
}

}  // namespace tactus::rendering
