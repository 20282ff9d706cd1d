// The lengthening of moves. Plain moves toward the goal shrink in a geometric series of the ratio
// r < 1: m, r m, r^2 m, and so on. One move of m / (1 - r) is their sum. With r > 1 the series
// grows: the sphere rolls off the feature, and the move is lengthened by 1 / (r - 1), at least
// fourfold.
#include "rendering/contact/curved_path.h"

#include <algorithm>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {

Vec3 CurvedPath::lengthen(const Vec3& move, const Vec3& p, const Vec3& h, const ProxyRest& rest,
                          const ContactPlanes& planes, const Triangle& triangle) {
  // The least lengthening of a move off a feature.
  constexpr double kRollingOff = 4.0;
  const Curvature curvature = rest.plane_count == 1   ? at_feature(move, p, h, rest, triangle)
                              : rest.plane_count == 2 ? along_crease(move, rest)
                                                      : Curvature{};
  const double most = curvature.max_share_of_radius * rest.planes[0].nearest.distance / move.norm();
  if (curvature.ratio == 0.0 || most <= 1.0) {
    return move;
  }
  // The plain move must end nearer to the tool than every plain move that was lengthened before, so
  // lengthened moves cannot go on for ever.
  const double left = (p + move - h).norm();
  double& least_left = least_left_m_[rest.plane_count - 1U];
  if (left >= least_left) {
    return move;
  }
  least_left = left;
  const double stretch = curvature.ratio < 1.0
                             ? 1.0 / (1.0 - curvature.ratio)
                             : std::max(kRollingOff, 1.0 / (curvature.ratio - 1.0));
  const Vec3 lengthened = move + (std::min(stretch, most) - 1.0) * curvature.part;
  return planes.allow(p + lengthened) ? lengthened : move;
}

// Returns the curvature across an edge or at a vertex. If friction takes most of the pull, only the
// rest draws the proxy. The lateral pull d and the pressure p change along the path s by
//
//   d' = p / R - 1,  p' = -d / R    across the edge,
//   d' = -1,         p' = 0         along it.
//
// With the friction f = mu p the rest d - f changes by the ratio cos^2 (p + mu d) / R, where the
// angle is between the path and the direction across. The rest is a difference of two nearly equal
// lengths, so it is not known far ahead.
CurvedPath::Curvature CurvedPath::at_feature(const Vec3& move, const Vec3& p, const Vec3& h,
                                             const ProxyRest& rest, const Triangle& triangle) {
  // The ratio of a move against friction is not known far ahead, so it is lengthened to 3 % of the
  // radius.
  constexpr double kMaxShareWithFriction = 0.03;
  const Nearest& nearest = rest.planes[0].nearest;
  if (nearest.feature == Feature::face) {
    return {};
  }
  const Vec3& normal = rest.planes[0].plane.normal;
  const Vec3 slide = tangential(move, normal);
  const double length = slide.norm();
  if (length == 0.0) {
    return {};
  }
  Vec3 across = slide;
  if (nearest.feature == Feature::edge) {
    const Vec3 edge = triangle.edge(nearest.edge).normalized();
    across -= slide.dot(edge) * edge;
  }
  const double pressure = rest.pressure_m[0];
  const double pull = tangential(h - p, normal).norm();
  const double held = pull - length;
  if (held <= length) {
    return {.ratio = pressure / nearest.distance, .part = across};
  }
  const double squared_cosine = across.squaredNorm() / (length * length);
  return {.ratio = squared_cosine * (pressure + held / pressure * pull) / nearest.distance,
          .part = slide,
          .max_share_of_radius = kMaxShareWithFriction};
}

CurvedPath::Curvature CurvedPath::along_crease(const Vec3& move, const ProxyRest& rest) const {
  // Two moves along one crease point the same way, to 8 degrees.
  constexpr double kAligned = 0.99;
  const double length = last_crease_move_.norm();
  if (move.dot(last_crease_move_) <= kAligned * length * move.norm()) {
    return {};
  }
  const Vec3 crease = rest.planes[0].plane.normal.cross(rest.planes[1].plane.normal).normalized();
  return {.ratio = move.norm() / length, .part = move.dot(crease) * crease};
}

}  // namespace tactus::rendering
