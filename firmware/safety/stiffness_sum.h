// Computes the stiffness of several parts of a scene together, in the direction in which it is
// largest.
//
// A spring that pushes only along n adds K n n^T, and one that is equal in all directions adds K.
// The potential field of a box has another n on each of its faces (safety/field_pieces.h), so every
// choice of one piece for each field is checked whose pieces overlap. Beyond edges and corners n
// n^T is replaced by the projection onto all possible directions, so the sum is an upper bound
// there. Elsewhere it is exact, except that positions are bounded by boxes.
//
// Not for a tick. It uses no heap, its work is bounded, and it may be called from any thread.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/safety/scene_part.h"

namespace tactus::firmware {

// The most parts in one set.
inline constexpr std::size_t kMostTogether = 16;

// Returns the largest stiffness of the part in the box, N/m.
double stiffness_in(const rendering::Bounds& box, const ScenePart& part);

// Returns the largest stiffness that the parts, at most kMostTogether, have together in any
// direction somewhere in the box, N/m. Fields of boxes count as equal in all directions if the sum
// is then at most `enough_N_per_m`, or if the search of their pieces has used up `looks_left`. The
// search reduces `looks_left`.
double stiffness_together(const rendering::Bounds& box, std::span<const ScenePart> parts,
                          double enough_N_per_m, std::size_t& looks_left);

}  // namespace tactus::firmware
