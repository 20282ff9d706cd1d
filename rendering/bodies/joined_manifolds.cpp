#include "rendering/bodies/joined_manifolds.h"

#include <algorithm>
#include <limits>

#include "rendering/bodies/point_choice.h"

namespace tactus::rendering {
namespace {

// Manifolds whose normals differ by less than the arccosine of this are one.
constexpr double kJoined = 0.9995;
// Points nearer than this are one, m.
constexpr double kJoinedPoint_m = 1e-9;

std::span<const ManifoldPoint> points_of(const Manifold& manifold) {
  return std::span(manifold.points).first(manifold.count);
}

double least_separation(const Manifold& manifold) {
  double least = std::numeric_limits<double>::infinity();
  for (const ManifoldPoint& point : points_of(manifold)) {
    least = std::min(least, point.separation_m);
  }
  return least;
}

Manifold join(const Manifold& a, const Manifold& b) {
  PointChoice choice(least_separation(b) < least_separation(a) ? b.normal_W : a.normal_W);
  for (const ManifoldPoint& point : points_of(a)) {
    choice.add(point);
  }
  for (const ManifoldPoint& point : points_of(b)) {
    const bool is_there = std::ranges::any_of(points_of(a), [&](const ManifoldPoint& other) {
      return (other.point_W - point.point_W).squaredNorm() < kJoinedPoint_m * kJoinedPoint_m;
    });
    if (!is_there) {
      choice.add(point);
    }
  }
  return choice.chosen();
}

}  // namespace

void JoinedManifolds::add(const Manifold& manifold) {
  if (manifold.count == 0) {
    return;
  }
  for (Manifold& other : std::span(manifolds_).first(count_)) {
    if (other.normal_W.dot(manifold.normal_W) > kJoined) {
      other = join(other, manifold);
      return;
    }
  }
  append(manifold);
}

void JoinedManifolds::append(const Manifold& manifold) {
  if (manifold.count == 0) {
    return;
  }
  if (count_ == kMostNormals) {
    left_out_ = true;
    return;
  }
  manifolds_[count_++] = manifold;
}

}  // namespace tactus::rendering
