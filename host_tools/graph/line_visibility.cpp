#include "host_tools/graph/line_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tactus::host {
namespace {

constexpr double kFarAway = -std::numeric_limits<double>::infinity();

// Returns twice the signed area of the triangle (a, b, (x, y)).
double doubled_area(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

}  // namespace

LineVisibility::LineVisibility(const Window& window, int pixels)
    : window_(window),
      pixels_(pixels),
      pixel_(window.width() / pixels),
      depths_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels), kFarAway) {}

void LineVisibility::add(std::span<const rendering::Float3> vertices,
                         std::span<const rendering::TriangleIndices> triangles) {
  // In pixels from the lower left corner.
  std::vector<Vec3> points;
  points.reserve(vertices.size());
  for (const rendering::Float3& vertex : vertices) {
    const Vec3 p = rendering::to_vec3(vertex);
    points.emplace_back((p.x() - window_.lower.right) / pixel_, (p.y() - window_.lower.up) / pixel_,
                        p.z());
  }
  for (const rendering::TriangleIndices& t : triangles) {
    add_triangle(points[t[0]], points[t[1]], points[t[2]]);
  }
}

void LineVisibility::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = doubled_area(a, b, c.x(), c.y());
  if (area == 0.0) {
    return;
  }
  const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
  const auto [bottom, top] = std::minmax({a.y(), b.y(), c.y()});
  const int first_column = std::max(0, static_cast<int>(std::floor(left)));
  const int last_column = std::min(pixels_ - 1, static_cast<int>(std::floor(right)));
  const int first_row = std::max(0, static_cast<int>(std::floor(bottom)));
  const int last_row = std::min(pixels_ - 1, static_cast<int>(std::floor(top)));
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double u = doubled_area(b, c, column + 0.5, row + 0.5) / area;
      const double v = doubled_area(c, a, column + 0.5, row + 0.5) / area;
      if (u < 0.0 || v < 0.0 || u + v > 1.0) {
        continue;
      }
      double& depth = depths_[static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels_) +
                              static_cast<std::size_t>(column)];
      depth = std::max(depth, u * a.z() + v * b.z() + (1.0 - u - v) * c.z());
    }
  }
}

// The depth within a pixel of a steep surface varies by more than any fixed slack. So a point is
// hidden only if the surface is in front of it in its pixel and in the eight about that one.
bool LineVisibility::hides(const Vec3& p) const {
  const int column = static_cast<int>(std::floor((p.x() - window_.lower.right) / pixel_));
  const int row = static_cast<int>(std::floor((p.y() - window_.lower.up) / pixel_));
  if (column < 1 || row < 1 || column > pixels_ - 2 || row > pixels_ - 2) {
    return false;
  }
  for (int i = row - 1; i <= row + 1; ++i) {
    for (int j = column - 1; j <= column + 1; ++j) {
      const double depth = depths_[static_cast<std::size_t>(i) * static_cast<std::size_t>(pixels_) +
                                   static_cast<std::size_t>(j)];
      if (depth < p.z() + pixel_) {
        return false;
      }
    }
  }
  return true;
}

std::vector<std::pair<Vec3, Vec3>> LineVisibility::visible_parts(const Vec3& a,
                                                                 const Vec3& b) const {
  constexpr double kPiece = 3.0;  // pixels
  const double length = std::hypot(b.x() - a.x(), b.y() - a.y()) / pixel_;
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / kPiece)));
  const auto at = [&](double piece) { return Vec3{a + piece / pieces * (b - a)}; };
  std::vector<std::pair<Vec3, Vec3>> parts;
  bool is_open = false;
  for (int i = 0; i < pieces; ++i) {
    const bool is_seen = !hides(at(i + 0.5));
    if (is_seen && is_open) {
      parts.back().second = at(i + 1);
    } else if (is_seen) {
      parts.emplace_back(at(i), at(i + 1));
    }
    is_open = is_seen;
  }
  return parts;
}

}  // namespace tactus::host
