// How stiff several parts of a scene are together, in the direction in which that is most.
//
// A spring that pushes along n alone adds K n n^T, and one that is alike in all directions K. The
// potential field of a box has another n on each of its faces (safety/field_pieces.h), so every
// choice of one piece for each of them is looked at that has a place in common. Beyond edges and
// corners n n^T is replaced by the projection onto all directions that are possible: the sum is
// then an upper bound, and elsewhere it is exact but for the places, which are boxes.
//
// Not for a tick. No heap, bounded work; any thread.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/safety/scene_part.h"

namespace tactus::firmware {

// The largest stiffness that the part has in the box, N/m.
double stiffness_in(const rendering::Bounds& box, const ScenePart& part);

// The largest stiffness that the parts have together in any direction somewhere in the box, N/m.
// Fields of boxes count as alike in all directions if the sum is then at most `enough_N_per_m`, or
// if the search of their pieces has used up `looks_left`.
double stiffness_together(const rendering::Bounds& box, std::span<const ScenePart> parts,
                          double enough_N_per_m, std::size_t& looks_left);

}  // namespace tactus::firmware
