// Where a potential field of a box pushes which way. Each of its faces has a place of its own, in
// which the push is along the face's normal; beyond the edges and corners a tool that is a sphere
// is pushed every way between the normals of the faces that meet there.
//
// Not for a tick. Pure functions of their arguments; any thread.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/geometry/vector.h"
#include "rendering/surface/primitive.h"

namespace tactus::firmware {

struct FieldPiece {
  rendering::Bounds box;  // all of the piece lies in it; world frame
  // The largest that n n^T can be, for every direction n of the push in the piece: the projection
  // onto all of them.
  Mat3 directions_W = Mat3::Zero();
};

// 6 faces, 12 edges and 8 corners.
inline constexpr std::size_t kMostFieldPieces = 26;

struct FieldPieces {
  std::array<FieldPiece, kMostFieldPieces> pieces;
  std::size_t count = 0;  // 6 for a tool without a radius
};

// The pieces of the field of a box, for a tool of that radius (m, >= 0), each larger by `slack_m`.
FieldPieces pieces_of_box(const rendering::Primitive& box, double tool_radius_m, double slack_m);

}  // namespace tactus::firmware
