// Solids that need no mesh: exact signed distances in closed form.
#pragma once

#include <array>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/surface/primitive_parts.h"
#include "rendering/surface/registered_primitives.h"

namespace tactus::rendering {

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::sphere;
  RigidPose X_WO;
  PrimitiveDimensions dimensions_m{};  // those that the kind does not name are ignored
};

// The distance from a point to a surface, and the nearest point's normal.
struct SurfaceSample {
  double distance_m = 0.0;  // signed: < 0 inside, and the distance to the surface on both sides
  Vec3 normal_W = Vec3::UnitX();  // unit, the distance's gradient; on the surface, outward
};

// Returns true if a touch may use the primitive: every number is finite, the rotation orthonormal
// and right-handed to 1e-9, the dimensions of its kind positive and at most kWorldBound_m, and its
// own condition met.
bool valid(const Primitive& primitive);

// Exact for every finite p_W, and 1-Lipschitz. Where several surface points are nearest one of them
// is taken, always the same: at a centre and on an axis the one toward +x of O (on the torus's
// centre circle the one farthest from its axis), on the middle planes of a box the positive side,
// and x before y before z. Any thread; no heap; the primitive must be valid.
SurfaceSample sample(const Primitive& primitive, const Vec3& p_W);

// The points of the surface that a sphere about a point may touch, in W.
struct SurfaceSamples {
  std::array<SurfaceSample, Contacts::kMost> samples{};
  std::size_t count = 0;
  // The first so many are with one round wall; samples[0] is then the nearest of it.
  std::size_t round_count = 0;
};

// Returns the points in which a sphere about p_W may touch the surface, at any distance: the walls
// round a point within a convex solid, and all round the hole of a torus. The plane through each of
// them, normal to its normal, bounds the sphere. From outside a convex solid, where the nearest
// point is the only contact, they are its walls as they are on the side of p_W. Any thread; no
// heap.
SurfaceSamples all_contacts(const Primitive& primitive, const Vec3& p_W);

// Returns true if the surface point that is nearest to p_W, for seen = sample(primitive, p_W), lies
// on an edge or a corner of a convex solid, and p_W outside it. Any thread; no heap.
bool is_nearest_on_edge(const Primitive& primitive, const SurfaceSample& seen, const Vec3& p_W);

// The surface point that `seen` speaks of, for seen = sample(primitive, p_W).
inline Vec3 nearest_point(const SurfaceSample& seen, const Vec3& p_W) {
  return p_W - seen.distance_m * seen.normal_W;
}

// The smallest axis-parallel box in W, but for the plane: its box is the world, kWorldBound_m to
// all sides.
Bounds bounds(const Primitive& primitive);

// Returns true for a convex solid. The primitive must be valid.
inline bool convex(const Primitive& primitive) {
  return kPrimitives[static_cast<std::size_t>(primitive.kind)].is_convex;
}

}  // namespace tactus::rendering
