// Everything is measured in the primitive's own frame. Solids of revolution are measured in the
// half plane (r, y) that holds the point, r its distance from the axis: the mirrored half never has
// a nearer surface point.
#include "rendering/surface/primitive.h"

#include <algorithm>
#include <cmath>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

using Vec2 = Eigen::Vector2d;

// Below this a length has no direction that division would give exactly.
constexpr double kNoLength_m = 1e-150;

struct Sample2 {
  double distance;
  Vec2 normal;  // (r, y)
};

struct Sample3 {
  double distance;
  Vec3 normal;  // frame O
};

double sign(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}

Sample3 plane(const Vec3& p) {
  return {p.y(), Vec3::UnitY()};
}

Sample3 sphere(const Vec3& p, double radius) {
  const double length = p.norm();
  return {length - radius, length > kNoLength_m ? Vec3{p / length} : Vec3::UnitX()};
}

// `over` is how far the point stands beyond each pair of faces, negative between them.
Sample3 box(const Vec3& p, const Vec3& half) {
  const Vec3 over = p.cwiseAbs() - half;
  Eigen::Index face = 0;
  if (over.maxCoeff(&face) > kNoLength_m) {
    const Vec3 outside = over.cwiseMax(0.0);
    const double distance = outside.norm();
    return {distance,
            Vec3{sign(p.x()) * outside.x(), sign(p.y()) * outside.y(), sign(p.z()) * outside.z()} /
                distance};
  }
  return {over[face], sign(p[face]) * Vec3::Unit(face)};
}

Sample2 disc(const Vec2& q, double radius) {
  const double length = q.norm();
  return {length - radius, length > kNoLength_m ? Vec2{q / length} : Vec2::UnitX()};
}

Sample2 rectangle(const Vec2& q, double radius, double half_height) {
  const Vec2 over(q.x() - radius, std::abs(q.y()) - half_height);
  if (over.maxCoeff() > kNoLength_m) {
    const Vec2 outside = over.cwiseMax(0.0);
    const double distance = outside.norm();
    return {distance, Vec2{outside.x(), sign(q.y()) * outside.y()} / distance};
  }
  return over.x() >= over.y() ? Sample2{over.x(), Vec2::UnitX()}
                              : Sample2{over.y(), sign(q.y()) * Vec2::UnitY()};
}

// The border from a to b, solid on its left, outward unit normal n: the distance from q if q is in
// front of it.
Sample2 from_border(const Vec2& q, const Vec2& a, const Vec2& b, const Vec2& n) {
  const Vec2 along = b - a;
  const double t = std::clamp((q - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const Vec2 offset = q - (a + t * along);
  const double height = n.dot(q - a);
  if (t > 0.0 && t < 1.0) {
    return {std::abs(height), height < 0.0 ? Vec2{-n} : n};
  }
  const double distance = offset.norm();
  return {distance, distance > kNoLength_m ? Vec2{offset / distance} : n};
}

Sample2 triangle(const Vec2& q, double radius, double height) {
  const Vec2 rim(radius, 0.0);
  const Vec2 tip(0.0, height);
  const Vec2 side_normal = Vec2(height, radius) / std::sqrt(height * height + radius * radius);
  const double above_side = side_normal.dot(q - rim);
  if (above_side <= 0.0 && q.y() >= 0.0) {
    return above_side >= -q.y() ? Sample2{above_side, side_normal}
                                : Sample2{-q.y(), -Vec2::UnitY()};
  }
  const Sample2 base = from_border(q, Vec2::Zero(), rim, -Vec2::UnitY());
  const Sample2 side = from_border(q, rim, tip, side_normal);
  return side.distance <= base.distance ? side : base;
}

template <class Profile>
Sample3 revolve(const Vec3& p, const Profile& profile) {
  const double r = std::sqrt(p.x() * p.x() + p.z() * p.z());
  const Vec3 outward = r > kNoLength_m ? Vec3{p.x() / r, 0.0, p.z() / r} : Vec3::UnitX();
  const Sample2 flat = profile(Vec2(r, p.y()));
  return {flat.distance, flat.normal.x() * outward + flat.normal.y() * Vec3::UnitY()};
}

Sample3 sample_in_O(const Primitive& primitive, const Vec3& p) {
  const double a = primitive.dimensions_m[0];
  const double b = primitive.dimensions_m[1];
  const double c = primitive.dimensions_m[2];
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return plane(p);
    case PrimitiveKind::sphere:
      return sphere(p, a);
    case PrimitiveKind::box:
      return box(p, Vec3(a, b, c));
    case PrimitiveKind::cylinder:
      return revolve(p, [&](const Vec2& q) { return rectangle(q, a, b); });
    case PrimitiveKind::capsule:
      return sphere(p - std::clamp(p.y(), -b, b) * Vec3::UnitY(), a);
    case PrimitiveKind::cone:
      return revolve(p, [&](const Vec2& q) { return triangle(q, a, b); });
    case PrimitiveKind::torus:
      return revolve(p, [&](const Vec2& q) { return disc(q - Vec2(a, 0.0), b); });
  }
  return plane(p);
}

std::size_t named_dimensions(PrimitiveKind kind) {
  switch (kind) {
    case PrimitiveKind::plane:
      return 0;
    case PrimitiveKind::sphere:
      return 1;
    case PrimitiveKind::box:
      return 3;
    default:
      return 2;
  }
}

// Half the extent along x, y and z of a disc about the unit axis.
Vec3 disc_extent(const Vec3& axis, double radius) {
  return radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

bool valid(const Primitive& primitive) {
  constexpr double kOrthonormal = 1e-9;
  const Mat3& rotation = primitive.X_WO.rotation;
  if (!rotation.allFinite() || !primitive.X_WO.translation.allFinite() ||
      primitive.kind > PrimitiveKind::torus) {
    return false;
  }
  const double skew = (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (skew > kOrthonormal || rotation.determinant() < 0.0) {
    return false;
  }
  const std::size_t count = named_dimensions(primitive.kind);
  for (std::size_t k = 0; k < count; ++k) {
    const double length = primitive.dimensions_m[k];
    const bool named_well = length > 0.0 && length <= kWorldBound_m;  // false for NaN
    if (!named_well) {
      return false;
    }
  }
  return primitive.kind != PrimitiveKind::torus ||
         primitive.dimensions_m[1] < primitive.dimensions_m[0];
}

SurfaceSample sample(const Primitive& primitive, const Vec3& p_W) {
  const Sample3 seen = sample_in_O(primitive, primitive.X_WO.point_in(p_W));
  return {.distance_m = seen.distance, .normal_W = primitive.X_WO.direction(seen.normal)};
}

Bounds bounds(const Primitive& primitive) {
  const double a = primitive.dimensions_m[0];
  const double b = primitive.dimensions_m[1];
  const Vec3& centre = primitive.X_WO.translation;
  const Vec3 axis = primitive.X_WO.rotation.col(1);
  Vec3 half = Vec3::Zero();
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return {.lower_W = Vec3::Constant(-kWorldBound_m), .upper_W = Vec3::Constant(kWorldBound_m)};
    case PrimitiveKind::sphere:
      half = Vec3::Constant(a);
      break;
    case PrimitiveKind::box:
      half = primitive.X_WO.rotation.cwiseAbs() * Vec3(a, b, primitive.dimensions_m[2]);
      break;
    case PrimitiveKind::cylinder:
      half = b * axis.cwiseAbs() + disc_extent(axis, a);
      break;
    case PrimitiveKind::capsule:
      half = b * axis.cwiseAbs() + Vec3::Constant(a);
      break;
    case PrimitiveKind::torus:
      half = disc_extent(axis, a) + Vec3::Constant(b);
      break;
    case PrimitiveKind::cone: {
      const Vec3 tip = centre + b * axis;
      const Vec3 rim = disc_extent(axis, a);
      return {.lower_W = (centre - rim).cwiseMin(tip), .upper_W = (centre + rim).cwiseMax(tip)};
    }
  }
  return {.lower_W = centre - half, .upper_W = centre + half};
}

}  // namespace tactus::rendering
