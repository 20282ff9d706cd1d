#include "rendering/bodies/placed_hull.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {

void PlacedHull::place(const ConvexHull& hull, const RigidPose& X_WO) {
  hull_ = hull;
  rotation_ = X_WO.rotation;
  translation_ = X_WO.translation;
  count_ = std::min(hull.vertices_O.size(), kMaxHullVertices);
  Vec3 lower = X_WO.point(hull.vertices_O[0]);
  Vec3 upper = lower;
  for (std::size_t i = 0; i < count_; ++i) {
    vertices_W_[i] = X_WO.point(hull.vertices_O[i]);
    lower = lower.cwiseMin(vertices_W_[i]);
    upper = upper.cwiseMax(vertices_W_[i]);
  }
  const std::size_t faces = std::min(hull.faces.size(), kKeptNormals);
  for (std::size_t f = 0; f < faces; ++f) {
    normals_W_[f] = rotation_ * hull.faces[f].normal_O;
  }
  middle_W_ = 0.5 * (lower + upper);
  half_W_ = 0.5 * (upper - lower);
  double farthest = 0.0;
  for (const Vec3& vertex : vertices_W()) {
    farthest = std::max(farthest, (vertex - middle_W_).squaredNorm());
  }
  reach_m_ = std::sqrt(farthest) + hull.radius_m;
}

void PlacedHull::enclose(std::span<const PlacedHull> hulls) {
  count_ = 0;
  Vec3 lower = hulls[0].middle_W_;
  Vec3 upper = lower;
  for (const PlacedHull& hull : hulls) {
    const Vec3 half = hull.half_W_ + Vec3::Constant(hull.hull_.radius_m);
    lower = lower.cwiseMin(hull.middle_W_ - half);
    upper = upper.cwiseMax(hull.middle_W_ + half);
  }
  middle_W_ = 0.5 * (lower + upper);
  half_W_ = 0.5 * (upper - lower);
  reach_m_ = 0.0;
  for (const PlacedHull& hull : hulls) {
    reach_m_ = std::max(reach_m_, (hull.middle_W_ - middle_W_).norm() + hull.reach_m_);
  }
}

PlacedHull::RimPoints PlacedHull::rim_points(const Vec3& normal_W) const {
  // Below this lean, rad, a circle lies in the plane: a lowest point would turn with the rounding.
  constexpr double kLean = 1e-3;
  // The slope of a side that lies along the plane.
  constexpr double kSlopeAlong = 0.1;
  const HullCircles& circles = *hull_.circles;
  const Vec3 axis = rotation_ * circles.axis_O;
  Vec3 up = normal_W - normal_W.dot(axis) * axis;
  const double lean = up.norm();
  if (lean > kLean) {
    up /= lean;
  } else {
    Eigen::Index least = 0;
    circles.axis_O.cwiseAbs().minCoeff(&least);
    up = (rotation_ * circles.axis_O.cross(Vec3::Unit(least))).normalized();
  }
  const Vec3 aside = axis.cross(up);
  RimPoints rim;
  std::array<Vec3, 2> lowest;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 center = rotation_ * circles.centers_O[i] + translation_;
    const double r = circles.radii_m[i];
    lowest[i] = center - r * up;
    rim.points[rim.count++] = lowest[i];
    if (r > 0.0) {
      rim.points[rim.count++] = center + r * up;
      rim.points[rim.count++] = center + r * aside;
      rim.points[rim.count++] = center - r * aside;
    }
  }
  const Vec3 side = lowest[1] - lowest[0];
  rim.is_along_side = lean > kLean && std::abs(side.dot(normal_W)) < kSlopeAlong * side.norm();
  return rim;
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
