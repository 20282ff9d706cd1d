#include "host_tools/bake/body/hull_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <utility>

#include "rendering/geometry/triangle.h"

namespace tactus::host {
namespace {

using rendering::TriangleIndices;

using HullEdge = std::pair<std::uint32_t, std::uint32_t>;

// The triangles of a hull, with what lies across their edges.
class HullSurface {
 public:
  HullSurface(std::span<const Vec3> points, std::span<const TriangleIndices> triangles)
      : points_(points), triangles_(triangles) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      shapes_.emplace_back(points[a], points[b], points[c]);
      areas_.push_back((points[b] - points[a]).cross(points[c] - points[a]).norm());
      for (std::size_t k = 0; k < 3; ++k) {
        owners_[edge(i, k)] = i;
      }
    }
  }

  // Returns for each triangle the number of its region. Regions grow from the largest triangles,
  // whose planes are the surest.
  [[nodiscard]] std::vector<std::uint32_t> regions(double tolerance) const {
    const auto numbers = std::views::iota(0U, static_cast<std::uint32_t>(triangles_.size()));
    std::vector<std::uint32_t> by_area(numbers.begin(), numbers.end());
    std::ranges::stable_sort(by_area, std::ranges::greater{},
                             [&](std::uint32_t i) { return areas_[i]; });
    std::vector<std::uint32_t> region(triangles_.size(), kNone);
    for (const std::uint32_t seed : by_area) {
      if (region[seed] != kNone) {
        continue;
      }
      region[seed] = seed;
      std::vector<std::uint32_t> grown{seed};
      for (std::size_t next = 0; next < grown.size(); ++next) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [from, to] = edge(grown[next], k);
          const std::uint32_t other = owners_.at({to, from});
          if (region[other] == kNone && belongs(other, shapes_[seed], tolerance)) {
            region[other] = seed;
            grown.push_back(other);
          }
        }
      }
    }
    return region;
  }

  // Returns the rims of the regions; nothing if one of them is no simple loop.
  [[nodiscard]] std::optional<std::vector<HullPolygon>> rims(
      std::span<const std::uint32_t> region) const {
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> next_of_region;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [from, to] = edge(i, k);
        if (region[owners_.at({to, from})] != region[i] &&
            !next_of_region[region[i]].try_emplace(from, to).second) {
          return std::nullopt;
        }
      }
    }
    std::vector<HullPolygon> polygons;
    for (const auto& [number, next] : next_of_region) {
      HullPolygon& polygon = polygons.emplace_back();
      std::uint32_t vertex = next.begin()->first;
      do {
        polygon.push_back(vertex);
        vertex = next.at(vertex);
      } while (vertex != polygon.front());
      if (polygon.size() != next.size()) {
        return std::nullopt;
      }
    }
    return polygons;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] HullEdge edge(std::uint32_t triangle, std::size_t k) const {
    return {triangles_[triangle][k], triangles_[triangle][(k + 1) % 3]};
  }

  // Returns true if the triangle is in the plane of the seed and looks the same way. One that is
  // thinner than the tolerance looks no way at all.
  [[nodiscard]] bool belongs(std::uint32_t triangle, const rendering::Triangle& seed,
                             double tolerance) const {
    const bool in_plane = std::ranges::all_of(triangles_[triangle], [&](std::uint32_t vertex) {
      return std::abs(seed.height(points_[vertex])) <= tolerance;
    });
    const rendering::Triangle& shape = shapes_[triangle];
    const double longest =
        std::max({shape.edge(0).norm(), shape.edge(1).norm(), shape.edge(2).norm()});
    constexpr double kSameWay = 0.5;
    return in_plane && (areas_[triangle] <= tolerance * longest ||
                        shape.normal().dot(seed.normal()) > kSameWay);
  }

  std::span<const Vec3> points_;
  std::span<const TriangleIndices> triangles_;
  std::vector<rendering::Triangle> shapes_;
  std::vector<double> areas_;
  std::map<HullEdge, std::uint32_t> owners_;
};

std::map<std::uint32_t, std::size_t> faces_at_vertices(std::span<const HullPolygon> polygons) {
  std::map<std::uint32_t, std::size_t> count;
  for (const HullPolygon& polygon : polygons) {
    for (const std::uint32_t vertex : polygon) {
      ++count[vertex];
    }
  }
  return count;
}

// Leaves out the vertices between two faces alone, and the polygons of which an edge is left.
void drop_loose_vertices(std::vector<HullPolygon>& polygons) {
  constexpr std::size_t kLeast = 3;
  for (std::size_t before = 0; before != polygons.size();) {
    before = polygons.size();
    const auto count = faces_at_vertices(polygons);
    for (HullPolygon& polygon : polygons) {
      std::erase_if(polygon, [&](std::uint32_t vertex) { return count.at(vertex) < kLeast; });
    }
    std::erase_if(polygons, [](const HullPolygon& polygon) { return polygon.size() < kLeast; });
  }
}

// Returns true if every corner of the triangles is on the polygons, within twice the tolerance. A
// vertex between two faces may be far from them where they meet at a very sharp or flat angle.
bool keeps_corners(std::span<const Vec3> points, std::span<const TriangleIndices> triangles,
                   std::span<const HullPolygon> polygons, double tolerance) {
  std::vector<rendering::Triangle> cut;
  for (const HullPolygon& polygon : polygons) {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      cut.emplace_back(points[polygon[0]], points[polygon[k]], points[polygon[k + 1]]);
    }
  }
  const auto kept = faces_at_vertices(polygons);
  return std::ranges::all_of(triangles, [&](const TriangleIndices& t) {
    return std::ranges::all_of(t, [&](std::uint32_t vertex) {
      return kept.contains(vertex) ||
             std::ranges::any_of(cut, [&](const rendering::Triangle& triangle) {
               return triangle.nearest(points[vertex]).distance <= 2.0 * tolerance;
             });
    });
  });
}

}  // namespace

bool is_polyhedron(std::span<const HullPolygon> polygons) {
  std::set<HullEdge> edges;
  for (const HullPolygon& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const HullEdge edge{polygon[k], polygon[(k + 1) % polygon.size()]};
      if (edge.first == edge.second || !edges.insert(edge).second) {
        return false;
      }
    }
  }
  const auto count = faces_at_vertices(polygons);
  constexpr std::size_t kLeast = 3;
  return std::ranges::all_of(
             edges, [&](const HullEdge& e) { return edges.contains({e.second, e.first}); }) &&
         std::ranges::all_of(count, [](const auto& entry) { return entry.second >= kLeast; }) &&
         count.size() + polygons.size() == edges.size() / 2 + 2;
}

std::vector<HullPolygon> join_coplanar(std::span<const Vec3> points,
                                       std::span<const TriangleIndices> triangles,
                                       double tolerance_m) {
  constexpr double kSmaller = 1.0 / 16.0;
  const HullSurface surface(points, triangles);
  for (const double tolerance : {tolerance_m, kSmaller * tolerance_m}) {
    auto polygons = surface.rims(surface.regions(tolerance));
    if (polygons) {
      drop_loose_vertices(*polygons);
      if (is_polyhedron(*polygons) && keeps_corners(points, triangles, *polygons, tolerance)) {
        return *std::move(polygons);
      }
    }
  }
  std::vector<HullPolygon> single;
  for (const TriangleIndices& t : triangles) {
    single.emplace_back(t.begin(), t.end());
  }
  return single;
}

}  // namespace tactus::host
