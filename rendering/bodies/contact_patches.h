// The places where a body touches a surface that is not convex, or not flat.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rendering/bodies/manifold.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// Collects points with their normals, and makes manifolds of those that agree. The surface is A.
class ContactPatches {
 public:
  // The most points that are collected. Beyond: the deepest stay.
  static constexpr std::size_t kMostPoints = 96;

  void clear() { count_ = 0; }
  // Adds a point, unless it is there with this normal, or nearly.
  void add(const Vec3& normal, const ManifoldPoint& point);
  void add(const Manifold& manifold);

  // Puts the points together by their normals, deepest first, and returns the manifolds. A manifold
  // has the normal of its deepest point; the others' differ by less than two degrees.
  std::span<const Manifold> reduce();

 private:
  struct Point {
    Vec3 normal = Vec3::UnitY();
    ManifoldPoint point;
    bool is_used = false;
  };

  // Returns the point with which the next manifold begins, or nullptr.
  const Point* next_point(std::size_t manifolds) const;

  std::array<Point, kMostPoints> points_;
  std::size_t count_ = 0;
  std::array<Manifold, kMaxContactPatches> manifolds_;
};

}  // namespace tactus::rendering
