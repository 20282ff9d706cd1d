// The mesh of a primitive, as fine as a test likes, and how far it is from the primitive.
#pragma once

#include "rendering/surface/primitive.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

struct MeshError {
  // The largest distance of an edge or a face from the surface, m.
  double chord_m = 0.0;
  // The largest angle between the normals of a face and of the surface at its corners, rad.
  double tilt = 0.0;
};

// Returns the mesh in the world frame, of `sides` parts round a circle; of a plane a square. Its
// vertices lie on the surface. Not many triangles meet in a point but at the tip of a cone.
Shape fine_mesh(const rendering::Primitive& primitive, int sides);

// Returns the error of a mesh whose vertices lie on the surface. World frame.
MeshError error_of(const Shape& mesh, const rendering::Primitive& primitive);

}  // namespace tactus::testing
