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
// An overlap so small that any face that has it will do, m.
constexpr double kShallow_m = 2e-5;

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

// Finds the part of a solid's vertices' hull that faces a direction: a face, or all vertices of a
// hull without faces.
void facing(const PlacedHull& hull, const Vec3& direction_W, Polygon& polygon) {
  if (hull.hull().circles != nullptr) {
    // A side that rolls has one line at the bottom.
    const PlacedHull::RimPoints rim = hull.rim_points(-direction_W);
    if (rim.is_along_side) {
      polygon.add(rim.points[0]);
      polygon.add(rim.points[hull.hull().circles->radii_m[0] > 0.0 ? 4 : 1]);
      return;
    }
  }
  if (hull.hull().faces.empty()) {
    std::ranges::for_each(hull.vertices_W(), [&](const Vec3& vertex) { polygon.add(vertex); });
    return;
  }
  for (const std::uint8_t corner : hull.corners(nearest_face(hull, direction_W).face)) {
    polygon.add(hull.vertices_W()[corner]);
  }
}

// Cuts off what lies beyond the plane through `point` with the outward `normal`, and writes the
// rest to `inside` (Sutherland and Hodgman, Communications of the ACM 17, 1974). Returns false, and
// writes nothing, if nothing lies beyond.
bool cut(const Polygon& polygon, const Vec3& point, const Vec3& normal, Polygon& inside) {
  std::array<double, kMostCorners> heights;
  bool is_cut = false;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    heights[i] = (polygon.corners_W[i] - point).dot(normal);
    is_cut = is_cut || !(heights[i] <= 0.0);
  }
  if (!is_cut) {
    return false;
  }
  inside.count = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const std::size_t next = i + 1 < polygon.count ? i + 1 : 0;
    const Vec3& here = polygon.corners_W[i];
    if (heights[i] <= 0.0) {
      inside.add(here);
    }
    // A segment has one side, not two.
    const bool is_side = polygon.count > 2 || i + 1 < polygon.count;
    if (is_side && (heights[i] <= 0.0) != (heights[next] <= 0.0)) {
      inside.add(here +
                 heights[i] / (heights[i] - heights[next]) * (polygon.corners_W[next] - here));
    }
  }
  return true;
}

// The points where the other solid stands on a face. `sign` is 1 if the face is A's, and -1 if it
// is B's.
Manifold on_face(const PlacedHull& owner, std::size_t face, const PlacedHull& other, double sign,
                 double margin_m) {
  const Vec3 normal = owner.normal_W(face);
  const auto corners = owner.corners(face);
  std::array<Polygon, 2> polygons;
  facing(other, -normal, polygons[0]);
  std::size_t now = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = owner.vertices_W()[corners[i]];
    const Vec3& to = owner.vertices_W()[corners[(i + 1) % corners.size()]];
    if (cut(polygons[now], from, (to - from).cross(normal), polygons[1 - now])) {
      now = 1 - now;
    }
  }
  const Polygon& polygon = polygons[now];
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

// Hulls with as many faces and vertices as a box, whose faces are quickly compared.
bool has_few_faces(const PlacedHull& hull) {
  constexpr std::size_t kFew = 8;
  return !hull.hull().faces.empty() && hull.hull().faces.size() <= kFew &&
         hull.vertices_W().size() <= kFew && hull.hull().radius_m == 0.0;
}

// The face beyond whose plane the other hull lies farthest, and how far; < 0 where it overlaps.
struct FaceGap {
  double gap_m = -std::numeric_limits<double>::infinity();
  std::size_t face = 0;
};
// Returns it, or the first face with a gap beyond the margin.
FaceGap widest_gap(const PlacedHull& owner, const PlacedHull& other, double margin_m) {
  FaceGap widest;
  for (std::size_t f = 0; f < owner.hull().faces.size(); ++f) {
    const Vec3 normal = owner.normal_W(f);
    const double height = owner.vertices_W()[owner.corners(f).front()].dot(normal);
    double gap = std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : other.vertices_W()) {
      gap = std::min(gap, vertex.dot(normal) - height);
      if (gap <= widest.gap_m) {
        break;
      }
    }
    if (gap > widest.gap_m) {
      widest = {.gap_m = gap, .face = f};
      if (gap > margin_m) {
        break;
      }
    }
  }
  return widest;
}

// Returns the points where a face of the other hull lies along this one; none if no face does.
Manifold on_facing_face(const PlacedHull& owner, std::size_t face, const PlacedHull& other,
                        double sign, double margin_m) {
  if (nearest_face(other, -owner.normal_W(face)).cosine < kAlong) {
    return {};
  }
  return on_face(owner, face, other, sign, margin_m);
}

}  // namespace

// Boxes that stand on each other overlap by no more than the soft contacts leave: their faces are
// then within kShallow_m of the best axis, and the search for that is left out.
Manifold manifold_of(const PlacedHull& a, const PlacedHull& b, double margin_m) {
  const double radii = a.hull().radius_m + b.hull().radius_m;
  const Vec3 reach = a.half_W() + b.half_W() + Vec3::Constant(radii + margin_m);
  if (((b.middle_W() - a.middle_W()).cwiseAbs().array() > reach.array()).any()) {
    return {};
  }
  if (has_few_faces(a) && has_few_faces(b)) {
    const FaceGap of_a = widest_gap(a, b, margin_m);
    const FaceGap of_b = of_a.gap_m > margin_m ? FaceGap{} : widest_gap(b, a, margin_m);
    if (std::max(of_a.gap_m, of_b.gap_m) > margin_m) {
      return {};
    }
    if (std::max(of_a.gap_m, of_b.gap_m) > -kShallow_m) {
      const bool is_of_a = of_a.gap_m >= of_b.gap_m - kShallow_m;
      const Manifold manifold = is_of_a ? on_facing_face(a, of_a.face, b, 1.0, margin_m)
                                        : on_facing_face(b, of_b.face, a, -1.0, margin_m);
      if (manifold.count > 0) {
        return manifold;
      }
    }
  }
  const HullSeparation apart = separation_of(a, b);
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
