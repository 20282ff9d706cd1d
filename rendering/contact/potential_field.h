// The potential field: a spring to the nearest point of the surface, from where the tool is and
// nothing else. It is the oldest way to render a solid and the baseline of the others. Its faults
// are part of it:
//
// - it keeps no place, so past the middle of a thin object the nearest surface is the far one, and
//   the tool pops through; an object of thickness t resists with at most K t / 2;
// - a tool that is beyond the object in one tick was never in it;
// - where the nearest point jumps (near corners, deep inside) the force jumps;
// - overlapping objects push each for itself.
//
// A tool that begins in it is the one thing that is remembered: IndependentContacts leaves the
// field out until the tool has been clear of it in a tick.
#pragma once

#include "rendering/surface/connected_mesh.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// The push of a field on the tool. IndependentContacts makes the force of it: F = K depth normal.
struct FieldPush {
  // The depth of the sphere below the surface, m; 0 outside.
  double depth_m = 0.0;
  // The unit vector out of the surface at the nearest point; zero outside.
  Vec3 normal_W = Vec3::Zero();
};

// Returns the push of a solid primitive on a sphere of the radius `tool_radius_m` >= 0 (0 is a
// point) at tool_W; m. Real time: no heap. A primitive costs some twenty multiplications; a mesh
// costs one search for the nearest point, also where nothing is touched but the mesh's box is.
FieldPush potential_field(const Primitive& primitive, const Vec3& tool_W, double tool_radius_m);

// Returns the push of a mesh. The mesh has to be closed and wound consistently; elsewhere the sign
// of the distance is a guess.
FieldPush potential_field(const ConnectedMesh& mesh, const Vec3& tool_W, double tool_radius_m);

}  // namespace tactus::rendering
