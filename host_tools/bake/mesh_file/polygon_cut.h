// Cuts a polygon in space into triangles. The readers of mesh files use it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// Cuts one polygon after the other and keeps its memory between them.
class PolygonCut {
 public:
  // Cuts off ears (Meisters, "Polygons have ears", 1975): corners that are convex, as seen along
  // the polygon's mean normal, and whose triangle has no other corner inside. `polygon` has at
  // least three indices into `vertices`. A polygon of n corners gives n - 2 triangles, wound as it
  // is, always. Returns false if at some step there is no ear, as in a polygon that crosses itself;
  // then triangles overlap. The time grows with the square of the corners, or with their cube in
  // the worst case.
  bool make(std::span<const Vec3> vertices, std::span<const std::uint32_t> polygon);

  // Returns the triangles of the last polygon, each as three places in `polygon`. They are valid
  // until the next call of make().
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> triangles() const {
    return triangles_;
  }

 private:
  // A corner in the plane of the polygon.
  using Point = Eigen::Vector2d;

  // Projects the polygon onto a plane across its mean normal, so that it winds to the left.
  void project(std::span<const Vec3> vertices, std::span<const std::uint32_t> polygon);
  // Returns twice the signed area of three corners, given as places in `points_`.
  [[nodiscard]] double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  // Returns true if the corner at place `k` of `left_` is an ear.
  [[nodiscard]] bool is_ear(std::size_t k) const;
  // Returns the place in `left_` of the corner to cut off next, searched from `start` on. Sets
  // `found` to false if there is no ear.
  [[nodiscard]] std::size_t next_ear(std::size_t start, bool& found) const;
  // Cuts a quadrilateral from its reflex corner, or from its first one.
  void cut_quadrilateral();

  std::vector<Point> points_;
  // The corners that are not cut off yet, as places in the polygon.
  std::vector<std::uint32_t> left_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace tactus::host
