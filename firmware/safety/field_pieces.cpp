#include "firmware/safety/field_pieces.h"

#include <cmath>

namespace tactus::firmware {
namespace {

using rendering::Bounds;

// Returns the smallest box along the axes of the world that contains a box along those of O.
Bounds in_world(const rendering::RigidPose& X_WO, const Bounds& box_O) {
  const Vec3 middle_W = X_WO.point(0.5 * (box_O.lower_W + box_O.upper_W));
  const Vec3 half_W = X_WO.rotation.cwiseAbs() * (0.5 * (box_O.upper_W - box_O.lower_W));
  return {.lower_W = middle_W - half_W, .upper_W = middle_W + half_W};
}

// Returns the box of the piece on the side `sides`: 0 for an axis along which the tool is within
// the box, 1 beyond its upper side, -1 beyond its lower side. The piece of a face extends into the
// box as far as the face is the nearest one: half of the box's smallest length.
Bounds piece_box_O(const Vec3& half_O, const std::array<int, 3>& sides, double beyond_m,
                   double slack_m) {
  const int beyond_count = std::abs(sides[0]) + std::abs(sides[1]) + std::abs(sides[2]);
  const double within_m = beyond_count == 1 ? half_O.minCoeff() : 0.0;
  Bounds box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const int side = sides[static_cast<std::size_t>(axis)];
    double least = -half_O[axis] - slack_m;
    double most = half_O[axis] + slack_m;
    if (side != 0) {
      least = half_O[axis] - within_m - slack_m;
      most = half_O[axis] + beyond_m + slack_m;
    }
    box.lower_W[axis] = side < 0 ? -most : least;
    box.upper_W[axis] = side < 0 ? -least : most;
  }
  return box;
}

}  // namespace

FieldPieces pieces_of_box(const rendering::Primitive& box, double tool_radius_m, double slack_m) {
  constexpr int kSides = 27;
  const Vec3 half_O(box.dimensions_m[0], box.dimensions_m[1], box.dimensions_m[2]);
  FieldPieces all;
  for (int number = 0; number < kSides; ++number) {
    // The 27 combinations of below, within and beyond along three axes; within along all is the
    // inside.
    const std::array<int, 3> sides{number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1};
    const Vec3 across_O(std::abs(sides[0]), std::abs(sides[1]), std::abs(sides[2]));
    const bool is_felt = across_O.sum() == 1.0 || (across_O.sum() > 1.0 && tool_radius_m > 0.0);
    if (!is_felt) {
      continue;
    }
    const Mat3& rotation = box.X_WO.rotation;
    all.pieces[all.count++] = {
        .box = in_world(box.X_WO, piece_box_O(half_O, sides, tool_radius_m, slack_m)),
        // The projection onto the axes across which the tool is pushed.
        .directions_W = rotation * across_O.asDiagonal() * rotation.transpose()};
  }
  return all;
}

}  // namespace tactus::firmware
