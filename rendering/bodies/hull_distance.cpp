#include "rendering/bodies/hull_distance.h"

#include <algorithm>
#include <array>
#include <limits>

#include "rendering/bodies/simplex.h"

namespace tactus::rendering {
namespace {

constexpr int kSupportSteps = 48;
// Hulls nearer than this count as overlapping: their nearest points give no direction.
constexpr double kTouching_m = 1e-10;
// The share of the distance by which a support point must be nearer to count as progress.
constexpr double kProgress = 1e-12;

// A simplex of the difference B - A, with the vertices that made its points.
struct DifferenceSimplex {
  Simplex simplex;
  std::array<std::size_t, 4> of_a{};
  std::array<std::size_t, 4> of_b{};

  void add(const PlacedHull& a, const PlacedHull& b, std::size_t i, std::size_t j) {
    of_a[simplex.count] = i;
    of_b[simplex.count] = j;
    simplex.points[simplex.count++] = b.vertices_W()[j] - a.vertices_W()[i];
  }
  [[nodiscard]] bool has(std::size_t i, std::size_t j) const {
    for (std::size_t k = 0; k < simplex.count; ++k) {
      if (of_a[k] == i && of_b[k] == j) {
        return true;
      }
    }
    return false;
  }
  // Keeps the points that are nearest to the origin. Returns true if it is within.
  bool reduce() {
    std::array<std::size_t, 4> kept{};
    if (reduce_to_nearest(simplex, kept)) {
      return true;
    }
    for (std::size_t k = 0; k < simplex.count; ++k) {
      of_a[k] = of_a[kept[k]];
      of_b[k] = of_b[kept[k]];
    }
    return false;
  }
};

// The axis of the largest separation so far.
struct BestAxis {
  double distance_m = -std::numeric_limits<double>::infinity();
  Vec3 normal_W = Vec3::UnitY();
  Vec3 on_a_W = Vec3::Zero();
  Vec3 on_b_W = Vec3::Zero();

  // Looks at a unit axis from A to B and the points that are nearest along it. An axis must be
  // better by more than rounding, so that faces, which come first, are not lost to edges.
  void consider(const Vec3& axis_W, const Vec3& nearest_a_W, const Vec3& nearest_b_W) {
    constexpr double kBetter_m = 1e-9;
    const double distance = (nearest_b_W - nearest_a_W).dot(axis_W);
    if (distance > distance_m + kBetter_m) {
      distance_m = distance;
      normal_W = axis_W;
      on_a_W = nearest_a_W;
      on_b_W = nearest_b_W;
    }
  }
};

void consider_faces(const PlacedHull& owner, const PlacedHull& other, double sign, BestAxis& best) {
  for (std::size_t f = 0; f < owner.hull().faces.size(); ++f) {
    const Vec3 normal = owner.normal_W(f);
    const Vec3& deepest = other.vertices_W()[other.support(-normal)];
    const Vec3& corner = owner.vertices_W()[owner.corners(f).front()];
    const Vec3 below = deepest - (deepest - corner).dot(normal) * normal;
    if (sign > 0.0) {
      best.consider(normal, below, deepest);
    } else {
      best.consider(-normal, deepest, below);
    }
  }
}

// Returns true if the arcs of two edges on the sphere of normals cross, seen from A and from -B: no
// other pair can make a face of the difference.
bool arcs_cross(const PlacedHull& a, const HullEdge& edge_a, const PlacedHull& b,
                const HullEdge& edge_b) {
  if (a.hull().faces.empty() || b.hull().faces.empty()) {
    return true;
  }
  const Vec3 p = a.normal_W(edge_a.left);
  const Vec3 q = a.normal_W(edge_a.right);
  const Vec3 r = -b.normal_W(edge_b.left);
  const Vec3 s = -b.normal_W(edge_b.right);
  const Vec3 qp = q.cross(p);
  const Vec3 sr = s.cross(r);
  const double rq = r.dot(qp);
  const double sq = s.dot(qp);
  const double pr = p.dot(sr);
  const double qr = q.dot(sr);
  return rq * sq < 0.0 && pr * qr < 0.0 && rq * qr > 0.0;
}

// Returns the points of two lines that are nearest to each other; the lines are not parallel.
std::array<Vec3, 2> nearest_of_lines(const Vec3& a, const Vec3& along_a, const Vec3& b,
                                     const Vec3& along_b) {
  const Vec3 between = b - a;
  const double aa = along_a.squaredNorm();
  const double bb = along_b.squaredNorm();
  const double ab = along_a.dot(along_b);
  const double determinant = aa * bb - ab * ab;
  const double s = (between.dot(along_a) * bb - between.dot(along_b) * ab) / determinant;
  const double t = (between.dot(along_a) * ab - between.dot(along_b) * aa) / determinant;
  return {a + s * along_a, b + t * along_b};
}

// Returns true if no vertex is farther along the axis than the point.
bool is_outermost(const PlacedHull& hull, const Vec3& point, const Vec3& axis) {
  constexpr double kRounding_m = 1e-9;
  return (hull.vertices_W()[hull.support(axis)] - point).dot(axis) <= kRounding_m;
}

void consider_edges(const PlacedHull& a, const PlacedHull& b, BestAxis& best) {
  constexpr double kParallel = 1e-6;
  for (const HullEdge& edge_a : a.hull().edges) {
    const Vec3& from_a = a.vertices_W()[edge_a.from];
    const Vec3 along_a = a.vertices_W()[edge_a.to] - from_a;
    for (const HullEdge& edge_b : b.hull().edges) {
      if (!arcs_cross(a, edge_a, b, edge_b)) {
        continue;
      }
      const Vec3& from_b = b.vertices_W()[edge_b.from];
      const Vec3 along_b = b.vertices_W()[edge_b.to] - from_b;
      const Vec3 cross = along_a.cross(along_b);
      const double length = cross.norm();
      if (!(length > kParallel * along_a.norm() * along_b.norm())) {
        continue;
      }
      Vec3 axis = cross / length;
      const Vec3 outward =
          a.hull().faces.empty() ? Vec3{b.middle_W() - from_b} : Vec3{from_a - a.middle_W()};
      if (axis.dot(outward) < 0.0) {
        axis = -axis;
      }
      const auto [on_a, on_b] = nearest_of_lines(from_a, along_a, from_b, along_b);
      if (is_outermost(a, on_a, axis) && is_outermost(b, on_b, -axis)) {
        best.consider(axis, on_a, on_b);
      }
    }
  }
}

HullSeparation overlap_of(const PlacedHull& a, const PlacedHull& b) {
  BestAxis best;
  consider_faces(a, b, 1.0, best);
  consider_faces(b, a, -1.0, best);
  consider_edges(a, b, best);
  if (!(best.distance_m > -std::numeric_limits<double>::infinity())) {
    // Neither has a face, and their edges do not cross: points and parallel segments that meet.
    Vec3 apart = b.middle_W() - a.middle_W();
    apart = apart.norm() > kTouching_m ? Vec3{apart.normalized()} : Vec3{Vec3::UnitY()};
    return {.distance_m = 0.0,
            .normal_W = apart,
            .on_a_W = a.vertices_W()[a.support(apart)],
            .on_b_W = b.vertices_W()[b.support(-apart)]};
  }
  return {.distance_m = std::min(best.distance_m, 0.0),
          .normal_W = best.normal_W,
          .on_a_W = best.on_a_W,
          .on_b_W = best.on_b_W};
}

}  // namespace

HullSeparation separation_of(const PlacedHull& a, const PlacedHull& b) {
  DifferenceSimplex difference;
  const Vec3 start = b.middle_W() - a.middle_W();
  difference.add(a, b, a.support(start), b.support(-start));
  for (int step = 0; step < kSupportSteps; ++step) {
    if (difference.reduce()) {
      return overlap_of(a, b);
    }
    const Vec3 nearest = difference.simplex.nearest();
    const double distance2 = nearest.squaredNorm();
    if (!(distance2 > kTouching_m * kTouching_m)) {
      return overlap_of(a, b);
    }
    const std::size_t i = a.support(nearest);
    const std::size_t j = b.support(-nearest);
    const Vec3 farther = b.vertices_W()[j] - a.vertices_W()[i];
    if (difference.has(i, j) || distance2 - nearest.dot(farther) <= kProgress * distance2) {
      break;
    }
    difference.add(a, b, i, j);
  }
  const Vec3 nearest = difference.simplex.nearest();
  HullSeparation result{.distance_m = nearest.norm()};
  result.normal_W = nearest / result.distance_m;
  result.on_a_W = Vec3::Zero();
  result.on_b_W = Vec3::Zero();
  for (std::size_t k = 0; k < difference.simplex.count; ++k) {
    result.on_a_W += difference.simplex.shares[k] * a.vertices_W()[difference.of_a[k]];
    result.on_b_W += difference.simplex.shares[k] * b.vertices_W()[difference.of_b[k]];
  }
  return result;
}

}  // namespace tactus::rendering
