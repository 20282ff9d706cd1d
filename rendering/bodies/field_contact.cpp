#include "rendering/bodies/field_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

// The steps of a descent on a face, and of the search for the nearest point of a ball.
constexpr int kDescentSteps = 10;
constexpr int kBallSteps = 6;
// A bump that comes nearer than the corners of a face by more than this counts, m.
constexpr double kBump_m = 1e-7;
// The descents on a face, beside that from its middle.
constexpr std::size_t kStarts = 4;
// A descent ends with steps shorter than this, m.
constexpr double kDescentEnd_m = 1e-7;

// Returns a point of a convex polygon with this normal, or of a segment, near a point of its plane:
// the point itself within.
Vec3 clamped(std::span<const Vec3> corners, const Vec3& normal, Vec3 p) {
  if (corners.size() == 2) {
    const Vec3 along = corners[1] - corners[0];
    const double t = (p - corners[0]).dot(along) / along.squaredNorm();
    return corners[0] + std::clamp(t, 0.0, 1.0) * along;
  }
  // Two rounds: a corner needs both of its sides.
  for (std::size_t i = 0; i < 2 * corners.size(); ++i) {
    const Vec3& from = corners[i % corners.size()];
    const Vec3 outward = (corners[(i + 1) % corners.size()] - from).cross(normal);
    const double beyond = (p - from).dot(outward);
    if (beyond > 0.0) {
      p -= beyond / outward.squaredNorm() * outward;
    }
  }
  return p;
}

}  // namespace

std::optional<SurfaceSample> ObstacleField::sample_at(const Vec3& p_O, double side) const {
  if (primitive != nullptr) {
    return sample(*primitive, p_O);
  }
  const Vec3 p = implicit->to_object(p_O);
  if (!implicit->bounds_O.contains(p)) {
    return std::nullopt;
  }
  const ValueAndGradient f = evaluate_gradient(implicit->formula, p);
  const double steepness = f.gradient.norm();
  if (!(steepness > 0.0) || !std::isfinite(f.value) || !std::isfinite(steepness)) {
    return std::nullopt;
  }
  const double sign = implicit->sides == Sides::two ? side : 1.0;
  return SurfaceSample{.distance_m = sign * implicit->scale_m * f.value / steepness,
                       .normal_W = sign * (implicit->R_WO * f.gradient) / steepness};
}

std::span<const Manifold> FieldContact::find(const ObstacleField& field, const PlacedHull& hull_O,
                                             double margin_m) {
  patches_.clear();
  side_ = 1.0;
  const std::optional<SurfaceSample> middle = field.sample_at(hull_O.middle_W(), 1.0);
  if (middle && middle->distance_m < 0.0) {
    side_ = -1.0;
  }
  const double radius = hull_O.hull().radius_m;
  const auto vertices = hull_O.vertices_W();
  for (const Vec3& vertex : vertices) {
    add(field, vertex, radius, margin_m);
  }
  if (vertices.size() == 2) {
    add_face(field, vertices, Vec3::Zero(), radius, margin_m);
  }
  std::array<Vec3, kMaxHullVertices> polygon;
  for (std::size_t f = 0; f < hull_O.hull().faces.size(); ++f) {
    const auto corners = hull_O.corners(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      polygon[i] = vertices[corners[i]];
    }
    add_face(field, std::span(polygon).first(corners.size()), hull_O.normal_W(f), radius, margin_m);
  }
  return patches_.reduce();
}

// The distance of a formula holds near the surface: for a ball it is taken where the ball comes
// nearest, and the direction there leads to that place.
void FieldContact::add(const ObstacleField& field, const Vec3& p_O, double radius_m,
                       double margin_m) {
  std::optional<SurfaceSample> seen = field.sample_at(p_O, side_);
  Vec3 lowest = p_O;
  for (int i = 0; seen && radius_m > 0.0 && i < kBallSteps; ++i) {
    const Vec3 next = p_O - radius_m * seen->normal_W;
    const double moved2 = (next - lowest).squaredNorm();
    lowest = next;
    seen = field.sample_at(lowest, side_);
    if (moved2 < kDescentEnd_m * kDescentEnd_m) {
      break;
    }
  }
  if (seen && seen->distance_m <= margin_m) {
    patches_.add(seen->normal_W, {.point_W = lowest - 0.5 * seen->distance_m * seen->normal_W,
                                  .separation_m = seen->distance_m});
  }
}

void FieldContact::add_face(const ObstacleField& field, Corners corners, const Vec3& normal,
                            double radius_m, double margin_m) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : corners) {
    middle += corner / static_cast<double>(corners.size());
  }
  double size = 0.0;
  for (const Vec3& corner : corners) {
    size = std::max(size, (corner - middle).norm());
  }
  const std::optional<SurfaceSample> seen = field.sample_at(middle, side_);
  // A face that looks away, or is farther than its size, does not touch. A formula's distance may
  // be wrong by a factor far away.
  if (!seen || seen->distance_m > 2.0 * size + radius_m + margin_m ||
      seen->normal_W.dot(normal) > 0.5) {
    return;
  }
  double corner_m = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : corners) {
    const auto at_corner = field.sample_at(corner, side_);
    corner_m = std::min(corner_m, at_corner ? at_corner->distance_m : corner_m);
  }
  const std::size_t starts = std::min(corners.size(), kStarts);
  for (std::size_t i = 0; i <= starts; ++i) {
    const Vec3 start =
        i == starts ? middle : Vec3{0.5 * (middle + corners[i * corners.size() / starts])};
    const Vec3 p = least_on(field, corners, normal, start, size);
    // The corners are there already: only a bump between them adds a point.
    const auto found = field.sample_at(p, side_);
    if (found && found->distance_m < corner_m - kBump_m) {
      add(field, p, radius_m, margin_m);
    }
  }
}

// Barzilai and Borwein's steps ("Two-point step size gradient methods", IMA Journal of Numerical
// Analysis 8, 1988): the last step over the change of the slope along it.
Vec3 FieldContact::least_on(const ObstacleField& field, Corners corners, const Vec3& normal,
                            const Vec3& start_O, double size_m) const {
  Vec3 p = start_O;
  std::optional<SurfaceSample> seen = field.sample_at(p, side_);
  if (!seen) {
    return p;
  }
  const auto slope_of = [&](const SurfaceSample& sample) -> Vec3 {
    return sample.normal_W - sample.normal_W.dot(normal) * normal;
  };
  double step = 0.5 * size_m;
  Vec3 best = p;
  double least = seen->distance_m;
  for (int i = 0; i < kDescentSteps; ++i) {
    const Vec3 slope = slope_of(*seen);
    const Vec3 next = clamped(corners, normal, p - step * slope);
    const Vec3 moved = next - p;
    const std::optional<SurfaceSample> there = field.sample_at(next, side_);
    if (!there || moved.norm() < kDescentEnd_m) {
      break;
    }
    const double bend = moved.dot(slope_of(*there) - slope);
    step = bend > 0.0 ? std::min(moved.squaredNorm() / bend, size_m / kDescentEnd_m) : size_m;
    p = next;
    seen = there;
    if (seen->distance_m < least) {
      least = seen->distance_m;
      best = p;
    }
  }
  return best;
}

}  // namespace tactus::rendering
