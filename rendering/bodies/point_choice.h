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
      points_[count_++] = point;
    }
  }

  [[nodiscard]] Manifold chosen() const {
    Manifold manifold{.normal_W = normal_W_};
    if (count_ <= kManifoldPoints) {
      std::copy_n(points_.begin(), count_, manifold.points.begin());
      manifold.count = count_;
      return manifold;
    }
    const Vec3 deepest = keep(manifold, [](const ManifoldPoint& p) { return -p.separation_m; });
    const Vec3 farthest =
        keep(manifold, [&](const ManifoldPoint& p) { return (p.point_W - deepest).squaredNorm(); });
    const Vec3 across = normal_W_.cross(farthest - deepest);
    keep(manifold, [&](const ManifoldPoint& p) { return (p.point_W - deepest).dot(across); });
    keep(manifold, [&](const ManifoldPoint& p) { return -(p.point_W - deepest).dot(across); });
    return manifold;
  }

 private:
  // Adds the point of the highest score, the first of several, unless it is there. Returns where it
  // is.
  template <class Score>
  Vec3 keep(Manifold& manifold, const Score& score) const {
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(count_);
    const ManifoldPoint& best = *std::ranges::max_element(points_.begin(), end, {}, score);
    const auto kept = std::span(manifold.points).first(manifold.count);
    if (std::ranges::find(kept, best.point_W, &ManifoldPoint::point_W) == kept.end()) {
      manifold.points[manifold.count++] = best;
    }
    return best.point_W;
  }

  Vec3 normal_W_;
  std::array<ManifoldPoint, kMost> points_;
  std::size_t count_ = 0;
};

}  // namespace tactus::rendering
