#include "host_tools/bake/mesh_file/polygon_cut.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tactus::host {
namespace {

// Returns the sum of the polygon's cross products about its first corner: twice its area along its
// mean normal (Newell). Differences come first, so that a polygon far from the origin loses
// nothing.
Vec3 mean_normal(std::span<const Vec3> vertices, std::span<const std::uint32_t> polygon) {
  const Vec3& origin = vertices[polygon[0]];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += (vertices[polygon[i]] - origin).cross(vertices[polygon[i + 1]] - origin);
  }
  return sum;
}

}  // namespace

void PolygonCut::project(std::span<const Vec3> vertices, std::span<const std::uint32_t> polygon) {
  const Vec3 normal = mean_normal(vertices, polygon);
  // A polygon without area has no plane; any will do, since its triangles are dropped later.
  const Vec3 n = normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
  const Vec3 u = n.unitOrthogonal();
  const Vec3 v = n.cross(u);
  points_.clear();
  left_.clear();
  for (std::uint32_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = vertices[polygon[i]] - vertices[polygon[0]];
    points_.emplace_back(p.dot(u), p.dot(v));
    left_.push_back(i);
  }
}

double PolygonCut::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const Point ab = points_[b] - points_[a];
  const Point ac = points_[c] - points_[a];
  return ab.x() * ac.y() - ab.y() * ac.x();
}

bool PolygonCut::is_ear(std::size_t k) const {
  const std::size_t n = left_.size();
  const std::uint32_t a = left_[(k + n - 1) % n];
  const std::uint32_t b = left_[k];
  const std::uint32_t c = left_[(k + 1) % n];
  if (!(turn(a, b, c) > 0.0)) {
    return false;
  }
  return std::ranges::none_of(left_, [&](std::uint32_t p) {
    const bool is_corner =
        points_[p] == points_[a] || points_[p] == points_[b] || points_[p] == points_[c];
    return !is_corner && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
  });
}

std::size_t PolygonCut::next_ear(std::size_t start, bool& found) const {
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const std::size_t k = (start + i) % left_.size();
    if (is_ear(k)) {
      return k;
    }
  }
  // Corners on a straight line leave no ear and take no area with them.
  for (std::size_t k = 0; k < left_.size(); ++k) {
    const std::size_t n = left_.size();
    if (turn(left_[(k + n - 1) % n], left_[k], left_[(k + 1) % n]) == 0.0) {
      return k;
    }
  }
  found = false;
  return start % left_.size();
}

void PolygonCut::cut_quadrilateral() {
  std::uint32_t first = 0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (turn((k + 3) % 4, k, (k + 1) % 4) < 0.0) {
      first = k;
    }
  }
  triangles_.push_back({first, (first + 1) % 4, (first + 2) % 4});
  triangles_.push_back({first, (first + 2) % 4, (first + 3) % 4});
}

bool PolygonCut::make(std::span<const Vec3> vertices, std::span<const std::uint32_t> polygon) {
  triangles_.clear();
  if (polygon.size() == 3) {
    triangles_.push_back({0, 1, 2});
    return true;
  }
  project(vertices, polygon);
  if (polygon.size() == 4) {
    cut_quadrilateral();
    return true;
  }
  bool simple = true;
  std::size_t start = 1;
  while (left_.size() > 3) {
    const std::size_t k = next_ear(start, simple);
    const std::size_t n = left_.size();
    triangles_.push_back({left_[(k + n - 1) % n], left_[k], left_[(k + 1) % n]});
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
    // The next corner but one comes next: cuts alternate and their triangles stay wide.
    start = k + 1;
  }
  triangles_.push_back({left_[0], left_[1], left_[2]});
  return simple;
}

}  // namespace tactus::host
