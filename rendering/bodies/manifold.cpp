#include "rendering/bodies/manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "rendering/bodies/hull_distance.h"
#include "rendering/bodies/point_choice.h"

namespace tactus::rendering {
namespace {

// The largest polygon that is cut.
constexpr std::size_t kMostCorners = PointChoice::kMost;
// A face lies along a normal within about 3 degrees.
constexpr double kAlong = 0.9986;

// A polygon, or a segment, or a point.
struct Polygon {
  std::array<Vec3, kMostCorners> corners_W;
  std::size_t count = 0;

  void add(const Vec3& point_W) {
    if (count < kMostCorners) {
      corners_W[count++] = point_W;
    }
  }
};

// Returns the face whose normal is nearest to a direction, and the cosine of the angle between.
struct NearestFace {
  std::size_t face = 0;
  double cosine = -std::numeric_limits<double>::infinity();
};
NearestFace nearest_face(const PlacedHull& hull, const Vec3& direction_W) {
  NearestFace best;
  for (std::size_t f = 0; f < hull.hull().faces.size(); ++f) {
    const double cosine = hull.normal_W(f).dot(direction_W);
    if (cosine > best.cosine) {
      best = {f, cosine};
    }
  }
  return best;
}

// Returns the part of a solid's vertices' hull that faces a direction: a face, or all vertices of a
// hull without faces.
Polygon facing(const PlacedHull& hull, const Vec3& direction_W) {
  Polygon polygon;
  if (hull.hull().circles != nullptr) {
    // A side that rolls has one line at the bottom.
    const PlacedHull::RimPoints rim = hull.rim_points(-direction_W);
    if (rim.is_along_side) {
      polygon.add(rim.points[0]);
      polygon.add(rim.points[hull.hull().circles->radii_m[0] > 0.0 ? 4 : 1]);
      return polygon;
    }
  }
  if (hull.hull().faces.empty()) {
    std::ranges::for_each(hull.vertices_W(), [&](const Vec3& vertex) { polygon.add(vertex); });
    return polygon;
  }
  for (const std::uint8_t corner : hull.corners(nearest_face(hull, direction_W).face)) {
    polygon.add(hull.vertices_W()[corner]);
  }
  return polygon;
}

// Cuts off what lies beyond the plane through `point` with the outward unit `normal` (Sutherland
// and Hodgman, Communications of the ACM 17, 1974).
Polygon cut(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3& here = polygon.corners_W[i];
    const Vec3& next = polygon.corners_W[(i + 1) % polygon.count];
    const double at_here = (here - point).dot(normal);
    const double at_next = (next - point).dot(normal);
    if (at_here <= 0.0) {
      inside.add(here);
    }
    // A segment has one side, not two.
    const bool is_side = polygon.count > 2 || i + 1 < polygon.count;
    if (is_side && (at_here <= 0.0) != (at_next <= 0.0)) {
      inside.add(here + at_here / (at_here - at_next) * (next - here));
    }
  }
  return inside;
}

// The points where the other solid stands on a face. `sign` is 1 if the face is A's, and -1 if it
// is B's.
Manifold on_face(const PlacedHull& owner, std::size_t face, const PlacedHull& other, double sign,
                 double margin_m) {
  const Vec3 normal = owner.normal_W(face);
  const auto corners = owner.corners(face);
  Polygon polygon = facing(other, -normal);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = owner.vertices_W()[corners[i]];
    const Vec3& to = owner.vertices_W()[corners[(i + 1) % corners.size()]];
    polygon = cut(polygon, from, (to - from).cross(normal).normalized());
  }
  PointChoice choice(sign * normal);
  const Vec3& corner = owner.vertices_W()[corners[0]];
  const double radius_owner = owner.hull().radius_m;
  const double radius_other = other.hull().radius_m;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3& point = polygon.corners_W[i];
    const double height = (point - corner).dot(normal);
    const double separation = height - radius_owner - radius_other;
    if (separation <= margin_m) {
      choice.add({.point_W = point - (radius_other + 0.5 * separation) * normal,
                  .separation_m = separation});
    }
  }
  return choice.chosen();
}

}  // namespace

Manifold manifold_of(const PlacedHull& a, const PlacedHull& b, double margin_m) {
  const double reach = a.reach_m() + b.reach_m() + margin_m;
  if ((b.middle_W() - a.middle_W()).squaredNorm() > reach * reach) {
    return {};
  }
  const HullSeparation apart = separation_of(a, b);
  const double radii = a.hull().radius_m + b.hull().radius_m;
  const double separation = apart.distance_m - radii;
  if (separation > margin_m) {
    return {};
  }
  const NearestFace of_a = nearest_face(a, apart.normal_W);
  const NearestFace of_b = nearest_face(b, -apart.normal_W);
  const bool is_of_a = of_a.cosine >= of_b.cosine - 1e-3;
  if (std::max(of_a.cosine, of_b.cosine) > kAlong) {
    const Manifold manifold = is_of_a ? on_face(a, of_a.face, b, 1.0, margin_m)
                                      : on_face(b, of_b.face, a, -1.0, margin_m);
    if (manifold.count > 0) {
      return manifold;
    }
  }
  const Vec3 on_a = apart.on_a_W + a.hull().radius_m * apart.normal_W;
  const Vec3 on_b = apart.on_b_W - b.hull().radius_m * apart.normal_W;
  Manifold manifold{.normal_W = apart.normal_W};
  manifold.points[0] = {.point_W = 0.5 * (on_a + on_b), .separation_m = separation};
  manifold.count = 1;
  return manifold;
}

Manifold manifold_of(const Vec3& point_W, const Vec3& normal_W, const PlacedHull& b,
                     double margin_m) {
  PointChoice choice(normal_W);
  const double radius = b.hull().radius_m;
  const PlacedHull::RimPoints rim =
      b.hull().circles != nullptr ? b.rim_points(normal_W) : PlacedHull::RimPoints{};
  const auto vertices = rim.count > 0 ? std::span(rim.points).first(rim.count) : b.vertices_W();
  for (const Vec3& vertex : vertices) {
    const double separation = (vertex - point_W).dot(normal_W) - radius;
    if (separation <= margin_m) {
      choice.add(
          {.point_W = vertex - (radius + 0.5 * separation) * normal_W, .separation_m = separation});
    }
  }
  return choice.chosen();
}

}  // namespace tactus::rendering
