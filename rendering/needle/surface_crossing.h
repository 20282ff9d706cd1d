// Finds the places at which a straight motion crosses a closed surface.
#pragma once

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/objects/object.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// The crossings of a motion from one point to another. Shares of the way are 0 at its start and 1
// at its end.
struct SurfaceCrossing {
  // True if the motion crosses the surface at all, inward, and outward.
  bool enters = false;
  bool leaves = false;
  // The share at the first crossing inward, and at the last one outward.
  double entry = 0.0;
  double exit = 1.0;
  // True if the motion ends inside. Of a mesh it has no meaning unless the motion crosses it.
  bool ends_inside = false;
};

// Returns the crossings of a closed mesh, in the mesh's frame. A motion through an edge or a vertex
// crosses the triangles on at least one side of it: two motions that follow each other never slip
// through between them. No heap; the time grows with the triangles near the way.
SurfaceCrossing crossing_of(const MeshView& mesh, const Vec3& from, const Vec3& to);

// Returns the crossings of a primitive, within a nanometre for a way that is not tangent to it, and
// exactly as to `ends_inside`. No heap, bounded time.
SurfaceCrossing crossing_of(const Primitive& primitive, const Vec3& from, const Vec3& to);

// Returns the crossings of an object that may_be_pierced(), in the object's frame.
inline SurfaceCrossing crossing_of(const Object& object, const Vec3& from_O, const Vec3& to_O) {
  return object.surface == SurfaceKind::primitive ? crossing_of(object.primitive, from_O, to_O)
                                                  : crossing_of(object.mesh, from_O, to_O);
}

}  // namespace tactus::rendering
