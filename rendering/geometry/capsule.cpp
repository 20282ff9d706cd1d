#include "rendering/geometry/capsule.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// A travel that leaves every capsule.
constexpr double kFar_m = 1e9;

// Returns where q + t d leaves the sphere of radius r about the origin, from a q inside: the larger
// root of a t^2 + 2 b t + c, with c <= 0. It takes the one of two forms of the root that adds
// numbers of the same sign, so that nothing cancels.
double larger_root(double a, double b, double c) {
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

}  // namespace

double Capsule::depth(const Vec3& p) const {
  const Vec3 from_start = p - start;
  const double squared_length = axis.squaredNorm();
  const double along =
      squared_length > 0.0 ? std::clamp(from_start.dot(axis) / squared_length, 0.0, 1.0) : 0.0;
  return radius - (from_start - along * axis).norm();
}

// The ray leaves through the cylinder without ends, unless that is beyond one of the ends: then it
// leaves through the sphere there.
double Capsule::room_along(const Vec3& p, const Vec3& direction) const {
  const Vec3 from_start = p - start;
  const double squared_length = axis.squaredNorm();
  const double squared_radius = radius * radius;
  // The place where the ray leaves, as a share of the axis.
  double along = 0.0;
  if (squared_length > 0.0) {
    const double p_along = from_start.dot(axis) / squared_length;
    const double d_along = direction.dot(axis) / squared_length;
    const Vec3 q = from_start - p_along * axis;
    const Vec3 d = direction - d_along * axis;
    const double a = d.squaredNorm();
    // A ray along the axis leaves through an end for certain.
    constexpr double kAlongAxis = 1e-18;
    const double travel =
        a > kAlongAxis ? larger_root(a, q.dot(d), q.squaredNorm() - squared_radius) : kFar_m;
    along = p_along + travel * d_along;
    if (along >= 0.0 && along <= 1.0) {
      return std::max(0.0, travel);
    }
  }
  const Vec3 q = along > 1.0 ? Vec3{from_start - axis} : from_start;
  return std::max(0.0, larger_root(1.0, q.dot(direction), q.squaredNorm() - squared_radius));
}

}  // namespace tactus::rendering
