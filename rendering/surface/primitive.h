// Solids that need no mesh: exact signed distances in closed form.
#pragma once

#include <array>
#include <cstdint>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The kinds of primitives in their own frame O, with the meaning of Primitive::dimensions_m. Axes
// are O's y.
enum class PrimitiveKind : std::uint8_t {
  plane,     // the half space y <= 0; no dimensions
  sphere,    // about the origin: radius
  box,       // about the origin: half its length along x, y, z
  cylinder,  // about the origin: radius, half its height
  capsule,   // about the origin: radius, half the length of its axis without the caps
  cone,      // base of the given radius about the origin in the plane y = 0, tip at y = height
  torus,     // about the origin, hole along y: radius of the centre circle, radius of the tube
};

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::sphere;
  RigidPose X_WO;
  std::array<double, 3> dimensions_m{};  // those that the kind does not name are ignored
};

// The distance from a point to a surface, and the nearest point's normal.
struct SurfaceSample {
  double distance_m = 0.0;  // signed: < 0 inside, and the distance to the surface on both sides
  Vec3 normal_W = Vec3::UnitX();  // unit, the distance's gradient; on the surface, outward
};

struct Bounds {
  Vec3 lower_W = Vec3::Zero();  // m
  Vec3 upper_W = Vec3::Zero();

  // Returns the distance from p_W to the box, m; 0 inside.
  [[nodiscard]] double distance(const Vec3& p_W) const {
    return (p_W - p_W.cwiseMax(lower_W).cwiseMin(upper_W)).norm();
  }
};

// Returns true if a touch may use the primitive: every number is finite, the rotation orthonormal
// and right-handed to 1e-9, the dimensions of its kind positive and at most kWorldBound_m, and the
// tube of a torus thinner than its centre circle.
bool valid(const Primitive& primitive);

// Exact for every finite p_W, and 1-Lipschitz. Where several surface points are nearest one of them
// is taken, always the same: at a centre and on an axis the one toward +x of O (on the torus's
// centre circle the one farthest from its axis), on the middle planes of a box the positive side,
// and x before y before z. Any thread; no heap; the primitive must be valid.
SurfaceSample sample(const Primitive& primitive, const Vec3& p_W);

// The surface point that `seen` speaks of, for seen = sample(primitive, p_W).
inline Vec3 nearest_point(const SurfaceSample& seen, const Vec3& p_W) {
  return p_W - seen.distance_m * seen.normal_W;
}

// The smallest axis-parallel box in W, but for the plane: its box is the world, kWorldBound_m to
// all sides.
Bounds bounds(const Primitive& primitive);

// Returns true for a convex solid: all kinds but the torus.
inline bool convex(const Primitive& primitive) {
  return primitive.kind != PrimitiveKind::torus;
}

}  // namespace tactus::rendering
