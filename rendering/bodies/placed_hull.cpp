#include "rendering/bodies/placed_hull.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {

void PlacedHull::place(const ConvexHull& hull, const RigidPose& X_WO) {
  hull_ = hull;
  rotation_ = X_WO.rotation;
  count_ = std::min(hull.vertices_O.size(), kMaxHullVertices);
  Vec3 lower = X_WO.point(hull.vertices_O[0]);
  Vec3 upper = lower;
  for (std::size_t i = 0; i < count_; ++i) {
    vertices_W_[i] = X_WO.point(hull.vertices_O[i]);
    lower = lower.cwiseMin(vertices_W_[i]);
    upper = upper.cwiseMax(vertices_W_[i]);
  }
  middle_W_ = 0.5 * (lower + upper);
  half_W_ = 0.5 * (upper - lower);
  double farthest = 0.0;
  for (const Vec3& vertex : vertices_W()) {
    farthest = std::max(farthest, (vertex - middle_W_).squaredNorm());
  }
  reach_m_ = std::sqrt(farthest) + hull.radius_m;
}

std::size_t PlacedHull::support(const Vec3& direction_W) const {
  std::size_t best = 0;
  double most = vertices_W_[0].dot(direction_W);
  for (std::size_t i = 1; i < count_; ++i) {
    const double along = vertices_W_[i].dot(direction_W);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return best;
}

}  // namespace tactus::rendering
