#include "host_tools/simulation/side_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host {
namespace {

// The coordinates of a ray's grid and its direction: across, up, and toward the side.
Vec3 seen(SeenFrom side, const Vec3& p_W) {
  return side == SeenFrom::front ? p_W : Vec3(p_W.z(), p_W.y(), p_W.x());
}

// Returns z of the triangle abc at (x, y), by barycentric coordinates in the xy plane; nothing if
// the triangle does not cover that point.
std::optional<double> height(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
  const auto cross = [](double ux, double uy, double vx, double vy) { return ux * vy - uy * vx; };
  const double area = cross(b.x() - a.x(), b.y() - a.y(), c.x() - a.x(), c.y() - a.y());
  if (area == 0.0) {
    return std::nullopt;
  }
  const double v = cross(x - a.x(), y - a.y(), c.x() - a.x(), c.y() - a.y()) / area;
  const double w = cross(b.x() - a.x(), b.y() - a.y(), x - a.x(), y - a.y()) / area;
  if (v < 0.0 || w < 0.0 || v + w > 1.0) {
    return std::nullopt;
  }
  return a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
}

// Returns the numbers of the lines between two coordinates: the first, and one behind the last.
std::pair<std::size_t, std::size_t> lines_between(const std::vector<double>& lines, double lower,
                                                  double upper) {
  const auto first = std::ranges::lower_bound(lines, lower);
  const auto end = std::ranges::upper_bound(lines, upper);
  return {static_cast<std::size_t>(first - lines.begin()),
          static_cast<std::size_t>(std::max(first, end) - lines.begin())};
}

// Returns rays evenly within a range, without its ends.
std::vector<double> evenly_within(double lower, double upper, std::size_t count) {
  std::vector<double> places(count);
  for (std::size_t i = 0; i < count; ++i) {
    places[i] =
        lower + (upper - lower) * static_cast<double>(i + 1) / static_cast<double>(count + 1);
  }
  return places;
}

}  // namespace

SideMap::SideMap(std::span<const rendering::Object> objects, SeenFrom side,
                 std::vector<double> across, std::vector<double> up)
    : across_m_(std::move(across)),
      up_m_(std::move(up)),
      reach_m_(across_m_.size() * up_m_.size()) {
  for (const rendering::Object& object : objects) {
    const auto corner = [&](std::uint32_t vertex) {
      return seen(side, rendering::to_vec3(object.mesh.vertices[vertex]));
    };
    for (const rendering::TriangleIndices& triangle : object.mesh.triangles) {
      meet(corner(triangle[0]), corner(triangle[1]), corner(triangle[2]));
    }
  }
}

void SideMap::meet(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 lower = a.cwiseMin(b).cwiseMin(c);
  const Vec3 upper = a.cwiseMax(b).cwiseMax(c);
  const auto [row_begin, row_end] = lines_between(up_m_, lower.y(), upper.y());
  const auto [begin, end] = lines_between(across_m_, lower.x(), upper.x());
  for (std::size_t row = row_begin; row < row_end; ++row) {
    for (std::size_t column = begin; column < end; ++column) {
      if (const auto z = height(a, b, c, across_m_[column], up_m_[row])) {
        std::optional<double>& most = reach_m_[row * across_m_.size() + column];
        most = std::max(*z, most.value_or(*z));
      }
    }
  }
}

bool SideMap::goes_on(std::size_t column, std::size_t next, std::size_t row) const {
  const std::optional<double> here = at(column, row);
  const std::optional<double> there = at(next, row);
  return here && there && std::abs(*there - *here) <= std::abs(across_m_[next] - across_m_[column]);
}

std::optional<std::size_t> SideMap::run_about(std::size_t column, std::size_t row) const {
  if (!at(column, row)) {
    return std::nullopt;
  }
  std::size_t right = column;
  while (right + 1 < across_m_.size() && goes_on(right, right + 1, row)) {
    ++right;
  }
  std::size_t left = column;
  while (left > 0 && goes_on(left, left - 1, row)) {
    --left;
  }
  return std::min(right - column, column - left);
}

std::optional<Vec3> broadest_place(std::span<const rendering::Object> objects, SeenFrom side,
                                   const rendering::Bounds& box) {
  constexpr std::size_t kRays = 65;
  const Vec3 lower = seen(side, box.lower_W);
  const Vec3 upper = seen(side, box.upper_W);
  const std::vector<double> across = evenly_within(lower.x(), upper.x(), kRays);
  const std::vector<double> up = evenly_within(lower.y(), upper.y(), kRays);
  const SideMap map(objects, side, across, up);
  const Vec3 middle = 0.5 * (lower + upper);
  std::optional<Vec3> best;
  std::size_t best_run = 0;
  const auto aside_m = [&](const Vec3& place) { return (place - middle).head<2>().norm(); };
  for (std::size_t row = 0; row < kRays; ++row) {
    for (std::size_t column = 0; column < kRays; ++column) {
      const auto run = map.run_about(column, row);
      if (!run) {
        continue;
      }
      const Vec3 place(across[column], up[row], map.at(column, row).value_or(0.0));
      if (!best || *run > best_run || (*run == best_run && aside_m(place) < aside_m(*best))) {
        best = place;
        best_run = *run;
      }
    }
  }
  // Exchanging the coordinates twice gives back the world's.
  return best ? std::optional(seen(side, *best)) : std::nullopt;
}

}  // namespace tactus::host
