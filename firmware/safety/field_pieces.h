// Divides the potential field of a box into pieces by the direction of its push. In the region of
// each face the push is along the face's normal. Beyond the edges and corners a spherical tool is
// pushed in every direction between the normals of the faces that meet there.
//
// Not for a tick. All are pure functions of their arguments, for any thread.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/geometry/vector.h"
#include "rendering/surface/primitive.h"

namespace tactus::firmware {

// One piece of the field.
struct FieldPiece {
  // A box along the axes that contains the whole piece, world frame, m.
  rendering::Bounds box;
  // An upper bound of n n^T for every direction n of the push in the piece: the projection onto all
  // of them.
  Mat3 directions_W = Mat3::Zero();
};

// The pieces are 6 faces, 12 edges and 8 corners.
inline constexpr std::size_t kMostFieldPieces = 26;

// All pieces of a box's field.
struct FieldPieces {
  std::array<FieldPiece, kMostFieldPieces> pieces;
  // The number of pieces: 6 for a tool without a radius, else 26.
  std::size_t count = 0;
};

// Returns the pieces of the field of a box, for a tool of that radius (m, >= 0). Each is enlarged
// by `slack_m`.
FieldPieces pieces_of_box(const rendering::Primitive& box, double tool_radius_m, double slack_m);

}  // namespace tactus::firmware
