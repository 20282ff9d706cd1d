#include "rendering/bodies/contact_patches.h"

#include <algorithm>
#include <limits>

#include "rendering/bodies/point_choice.h"

namespace tactus::rendering {
namespace {

// Normals that agree.
constexpr double kOneNormal = 0.9995;
// Points nearer than this are one, m.
constexpr double kSame_m = 1e-9;
// A point with another normal counts as deeper by this, m, times one minus the cosine between: it
// may hold the body in a direction in which the manifolds so far do not.
constexpr double kOtherNormal_m = 1e-3;

}  // namespace

void ContactPatches::add(const Vec3& normal, const ManifoldPoint& point) {
  const auto points = std::span(points_).first(count_);
  const bool is_there = std::ranges::any_of(points, [&](const Point& p) {
    return (p.point.point_W - point.point_W).squaredNorm() < kSame_m * kSame_m &&
           p.normal.dot(normal) > kOneNormal;
  });
  if (is_there) {
    return;
  }
  if (count_ < kMostPoints) {
    points_[count_++] = {.normal = normal, .point = point};
    return;
  }
  Point& shallowest =
      *std::ranges::max_element(points, {}, [](const Point& p) { return p.point.separation_m; });
  if (point.separation_m < shallowest.point.separation_m) {
    shallowest = {.normal = normal, .point = point};
  }
}

void ContactPatches::add(const Manifold& manifold) {
  for (const ManifoldPoint& point : std::span(manifold.points).first(manifold.count)) {
    add(manifold.normal_W, point);
  }
}

std::span<const Manifold> ContactPatches::reduce() {
  std::size_t count = 0;
  while (count < kMaxContactPatches) {
    const Point* const first = next_point(count);
    if (first == nullptr) {
      break;
    }
    const Vec3 normal = first->normal;
    PointChoice choice(normal);
    for (Point& p : std::span(points_).first(count_)) {
      if (!p.is_used && p.normal.dot(normal) > kOneNormal) {
        choice.add(p.point);
        p.is_used = true;
      }
    }
    manifolds_[count++] = choice.chosen();
  }
  return {manifolds_.data(), count};
}

const ContactPatches::Point* ContactPatches::next_point(std::size_t manifolds) const {
  const Point* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Point& p : std::span(points_).first(count_)) {
    if (p.is_used) {
      continue;
    }
    double likeness = manifolds == 0 ? 0.0 : -1.0;
    for (const Manifold& manifold : std::span(manifolds_).first(manifolds)) {
      likeness = std::max(likeness, manifold.normal_W.dot(p.normal));
    }
    const double score = p.point.separation_m + kOtherNormal_m * likeness;
    if (score < least) {
      least = score;
      best = &p;
    }
  }
  return best;
}

}  // namespace tactus::rendering
