// The choice of the points of a contact that stay, where there are more than a manifold holds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "rendering/bodies/manifold.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// Keeps the points of a manifold that hold the body best: the deepest, the farthest from it, and
// those that span most to both sides of the line between.
class PointChoice {
 public:
  // The most points to choose from: a face with all vertices of a hull, and a corner for every cut.
  // Beyond: the last ones are left out.
  static constexpr std::size_t kMost = 2 * kMaxHullVertices;

  explicit PointChoice(Vec3 normal_W) : normal_W_(std::move(normal_W)) {}

  void add(const ManifoldPoint& point) {
    if (count_ < kMost) {
      points_W_[count_] = point.point_W;
      separations_m_[count_++] = point.separation_m;
    }
  }

  [[nodiscard]] Manifold chosen() const {
    Manifold manifold{.normal_W = normal_W_};
    if (count_ <= kManifoldPoints) {
      for (std::size_t i = 0; i < count_; ++i) {
        manifold.points[i] = {.point_W = points_W_[i], .separation_m = separations_m_[i]};
      }
      manifold.count = count_;
      return manifold;
    }
    const Vec3 deepest = keep(manifold, [&](std::size_t i) { return -separations_m_[i]; });
    const Vec3 farthest =
        keep(manifold, [&](std::size_t i) { return (points_W_[i] - deepest).squaredNorm(); });
    const Vec3 across = normal_W_.cross(farthest - deepest);
    keep(manifold, [&](std::size_t i) { return (points_W_[i] - deepest).dot(across); });
    keep(manifold, [&](std::size_t i) { return -(points_W_[i] - deepest).dot(across); });
    return manifold;
  }

 private:
  // Adds the point of the highest score, the first of several, unless it is there. Returns where it
  // is.
  template <class Score>
  Vec3 keep(Manifold& manifold, const Score& score) const {
    std::size_t best = 0;
    double highest = score(0);
    for (std::size_t i = 1; i < count_; ++i) {
      const double here = score(i);
      if (here > highest) {
        highest = here;
        best = i;
      }
    }
    const auto kept = std::span(manifold.points).first(manifold.count);
    if (std::ranges::find(kept, points_W_[best], &ManifoldPoint::point_W) == kept.end()) {
      manifold.points[manifold.count++] = {.point_W = points_W_[best],
                                           .separation_m = separations_m_[best]};
    }
    return points_W_[best];
  }

  Vec3 normal_W_;
  // Only the first `count_` are set: clearing the others would take longer than the choice.
  std::array<Vec3, kMost> points_W_;
  std::array<double, kMost> separations_m_;
  std::size_t count_ = 0;
};

}  // namespace tactus::rendering
