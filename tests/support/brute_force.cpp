#include "tests/support/brute_force.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus::testing {
namespace {

using rendering::to_vec3;

Vec3 nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& q) {
  const Vec3 d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((q - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return a + t * d;
}

// Distance of two segments: alternate projection from several starts converges to the minimum of a
// convex function.
double segment_segment(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Vec3 u = b - a;
  const Vec3 v = q - p;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](double t) {
    const Vec3 x = a + std::clamp(t, 0.0, 1.0) * u;
    const Vec3 y = nearest_on_segment(p, q, x);
    best = std::min(best, (nearest_on_segment(a, b, y) - y).norm());
  };
  consider(0.0);
  consider(1.0);
  if (determinant > 1e-14 * uu * vv) {
    consider((uv * v.dot(a - p) - vv * u.dot(a - p)) / determinant);
  }
  best = std::min(best, (nearest_on_segment(a, b, p) - p).norm());
  best = std::min(best, (nearest_on_segment(a, b, q) - q).norm());
  return best;
}

bool pierces(const Corners& t, const Vec3& p, const Vec3& q) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
  };
  const double from = volume(t.a, t.b, t.c, p);
  const double to = volume(t.a, t.b, t.c, q);
  if ((from > 0.0) == (to > 0.0)) {
    return false;
  }
  const double x = volume(p, q, t.a, t.b);
  const double y = volume(p, q, t.b, t.c);
  const double z = volume(p, q, t.c, t.a);
  return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
}

// The distance of the segment to the ball round the triangle, to the box round it along the axes,
// and to its plane, each bounds that to the triangle from below.
double ball_distance(const Corners& t, const Vec3& p, const Vec3& q) {
  return (nearest_on_segment(p, q, t.centre) - t.centre).norm() - t.radius_m;
}

double box_distance(const Corners& t, const Vec3& p, const Vec3& q) {
  const Vec3 below = t.a.cwiseMin(t.b).cwiseMin(t.c) - p.cwiseMax(q);
  const Vec3 above = p.cwiseMin(q) - t.a.cwiseMax(t.b).cwiseMax(t.c);
  return below.cwiseMax(above).cwiseMax(0.0).norm();
}

double plane_distance(const Corners& t, const Vec3& p, const Vec3& q) {
  constexpr double kRounding = 1e-14;  // of the volumes, for a sliver's normal is not good
  const Vec3 u = t.b - t.a;
  const Vec3 v = t.c - t.a;
  const Vec3 normal = u.cross(v);
  const double area = normal.norm();
  const double from = normal.dot(p - t.a);
  const double to = normal.dot(q - t.a);
  if (area == 0.0 || (from > 0.0) != (to > 0.0)) {
    return 0.0;
  }
  const double rounding =
      kRounding * u.norm() * v.norm() * std::max((p - t.a).norm(), (q - t.a).norm());
  return (std::min(std::abs(from), std::abs(to)) - rounding) / area;
}

}  // namespace

std::vector<Corners> corners_of(const Shape& shape) {
  std::vector<Corners> result;
  for (const auto& [i, j, k] : shape.triangles) {
    Corners t{to_vec3(shape.vertices[i]),
              to_vec3(shape.vertices[j]),
              to_vec3(shape.vertices[k]),
              {},
              0.0};
    t.centre = (t.a + t.b + t.c) / 3.0;
    t.radius_m = std::sqrt(std::max({(t.a - t.centre).squaredNorm(), (t.b - t.centre).squaredNorm(),
                                     (t.c - t.centre).squaredNorm()}));
    result.push_back(t);
  }
  return result;
}

// The least square of a triangle's height above its longer side, as a share of the side's square.
constexpr double kFlatTriangle = 2e-31;

Vec3 nearest_point(const Corners& t, const Vec3& q) {
  // Least squares by the method of Gram and Schmidt, the longer side first. Its second pass takes
  // away what rounding has left of that side in the shorter one.
  Vec3 longer = t.b - t.a;
  Vec3 shorter = t.c - t.a;
  if (longer.squaredNorm() < shorter.squaredNorm()) {
    std::swap(longer, shorter);
  }
  const double square = longer.squaredNorm();
  double along = longer.dot(shorter) / square;
  Vec3 across = shorter - along * longer;
  const double rest = longer.dot(across) / square;
  along += rest;
  across -= rest * longer;
  const Vec3 from_a = q - t.a;
  const double of_shorter = across.dot(from_a) / across.squaredNorm();
  const double of_longer = longer.dot(from_a - of_shorter * across) / square - along * of_shorter;
  // Nothing but its sides is left of a triangle without an area.
  const bool is_flat = across.squaredNorm() <= kFlatTriangle * square;
  if (!is_flat && of_longer >= 0.0 && of_shorter >= 0.0 && of_longer + of_shorter <= 1.0) {
    return t.a + of_longer * longer + of_shorter * shorter;
  }
  Vec3 best = nearest_on_segment(t.a, t.b, q);
  for (const Vec3& other : {nearest_on_segment(t.b, t.c, q), nearest_on_segment(t.c, t.a, q)}) {
    best = (other - q).squaredNorm() < (best - q).squaredNorm() ? other : best;
  }
  return best;
}

double segment_distance(const Corners& t, const Vec3& p, const Vec3& q) {
  if (p == q) {
    return (nearest_point(t, p) - p).norm();
  }
  if (pierces(t, p, q)) {
    return 0.0;
  }
  return std::min({(nearest_point(t, p) - p).norm(), (nearest_point(t, q) - q).norm(),
                   segment_segment(t.a, t.b, p, q), segment_segment(t.b, t.c, p, q),
                   segment_segment(t.c, t.a, p, q)});
}

double clearance(std::span<const Corners> triangles, const Vec3& p, const Vec3& q, double within) {
  double best = std::numeric_limits<double>::infinity();
  for (const Corners& t : triangles) {
    const double most = std::min(within, best);
    if (ball_distance(t, p, q) <= most && box_distance(t, p, q) <= most &&
        plane_distance(t, p, q) <= most) {
      best = std::min(best, segment_distance(t, p, q));
    }
  }
  return best;
}

double descent_left(const Vec3& p, const Vec3& h, std::span<const Vec3> normals) {
  // The projection on a polyhedral cone is the projection on one of its faces: the wish itself, on
  // a plane, on a line between two planes, or zero. Each of these that lies within the cone is a
  // direction of descent as steep as it is long.
  const Vec3 wish = h - p;
  double best = 0.0;
  const auto consider = [&](const Vec3& u) {
    // Normals are good to a nanoradian, and the wish, most of which u has cancelled, to rounding.
    const double slack = 1e-9 * u.norm() + 1e-12 * wish.norm();
    const bool allowed =
        std::ranges::all_of(normals, [&](const Vec3& n) { return n.dot(u) >= -slack; });
    if (allowed) {
      best = std::max(best, u.norm());
    }
  };
  consider(wish);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    consider(wish - wish.dot(normals[i]) * normals[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 crease = normals[i].cross(normals[j]);
      if (crease.squaredNorm() > 1e-12) {
        consider(wish.dot(crease) / crease.squaredNorm() * crease);
      }
    }
  }
  return best;
}

double descent_left(const Vec3& p, const Vec3& h, std::span<const Corners> triangles,
                    double reach) {
  std::vector<Vec3> normals;
  for (const Corners& t : triangles) {
    if ((p - t.centre).norm() > reach + t.radius_m) {
      continue;
    }
    const Vec3 offset = p - nearest_point(t, p);
    if (offset.norm() <= reach) {
      normals.push_back(offset.normalized());
    }
  }
  return descent_left(p, h, normals);
}

}  // namespace tactus::testing
